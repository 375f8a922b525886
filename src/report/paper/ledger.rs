//! The ledger: each claim of the paper beside what its own tables and each measured device say.

use anyhow::{Context as _, Result};
use serde::Serialize;

use super::claims::Claim;
use super::evidence::{Evidence, Finding, Verdict};
use super::published::Publication;
use super::sheet::{Sheet, Source};
use crate::report::groups::Group;
use crate::report::table::{Cell, Column, Table, escape};
use crate::table::text;

pub(crate) const SOFTWARE_NOTE: &str = "renders in software: its times say nothing about GPUs, and neither \
    do its verdicts.";

#[derive(Debug)]
pub(crate) struct Ledger {
    pub entries: Vec<Entry>,
    /// The measured devices that render in software.
    pub software: Vec<String>,
}

#[derive(Debug)]
pub(crate) struct Entry {
    pub claim: &'static Claim,
    /// What the paper's own tables give, then what each measured device gives.
    pub findings: Vec<(Measurer, Finding)>,
}

/// Whose numbers a finding is about.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Measurer {
    source: &'static str,
    device: String,
    software: bool,
}

impl Ledger {
    pub(super) fn new(
        paper: &'static Publication,
        sheets: &[Sheet],
        groups: &[Group<'_>],
    ) -> Result<Self> {
        let own = Measurer {
            source: "paper",
            device: "The paper's own tables".to_owned(),
            software: false,
        };
        let mut measurers = vec![(own, Source::Paper)];
        measurers.extend(groups.iter().enumerate().map(|(index, group)| {
            let measurer = Measurer {
                source: "measured",
                device: group.label.clone(),
                software: group.software,
            };
            (measurer, Source::Measured(index))
        }));
        let entry = |claim: &'static Claim| {
            let find = |(who, source): &(Measurer, Source)| {
                let source = *source;
                let mut found = claim.check.find(&Evidence { sheets, source })?;
                if source == Source::Paper {
                    found.verdict = Verdict::Own;
                }
                Ok((who.clone(), found))
            };
            let findings = measurers.iter().map(find).collect::<Result<_>>();
            let findings =
                findings.with_context(|| format!("cannot check the claim {}", claim.id))?;
            Ok(Entry { claim, findings })
        };
        let software = groups.iter().filter(|group| group.software);
        Ok(Self {
            entries: paper.claims.iter().map(entry).collect::<Result<_>>()?,
            software: software.map(|group| group.label.clone()).collect(),
        })
    }

    pub(crate) fn csv(&self) -> Result<String> {
        let mut rows = Vec::new();
        for Entry { claim, findings } in &self.entries {
            rows.extend(findings.iter().map(|(who, finding)| (*claim, who, finding)));
        }
        Ok(String::from_utf8(text(&rows)?)?)
    }

    pub(crate) fn markdown(&self) -> String {
        let software = self.software.iter();
        let software = software.map(|device| format!("**{}** {SOFTWARE_NOTE}\n\n", escape(device)));
        let (software, rules) = (software.collect::<String>(), self.rules());
        let rules = rules.iter().map(|(ids, rule)| format!("- {ids}: {rule}\n"));
        let (rules, table) = (rules.collect::<String>(), self.table().markdown());
        format!("# The paper's claims\n\n{software}{table}\n## How verdicts are reached\n\n{rules}")
    }

    /// The claims as groups of rows, a row a measurer.
    pub(crate) fn table(&self) -> Table {
        let columns = ["Device", "Verdict", "Rests on"].map(Column::text);
        let columns = columns
            .into_iter()
            .chain([Column::text("Found").class("found")]);
        let mut table = Table::new("The paper's claims", columns).class("ledger");
        for Entry { claim, findings } in &self.entries {
            let wide = maud::html! {
                (claim.text) span.quiet { " Claimed: " (claim.claimed) ". " code { (claim.id) } }
            };
            let claimed = format!("claimed: {}", claim.claimed).into();
            let plain = vec![Cell::strong(&claim.text), "".into(), "".into(), claimed];
            table.begin(Cell::drawn(wide), plain);
            table = table.extend(findings.iter().map(|(who, finding)| {
                let verdict = Cell::from(finding.verdict.word()).class(match finding.verdict {
                    Verdict::Reproduced => "verdict held",
                    Verdict::TrendOnly => "verdict trend",
                    Verdict::NotReproduced => "verdict broken",
                    Verdict::NotMeasured => "verdict quiet",
                    Verdict::Own => "",
                });
                let mut found = Cell::from(finding.text.as_str());
                if finding.verdict == Verdict::Own && !claim.note.is_empty() {
                    found = found.small(&claim.note);
                }
                [
                    who.device.as_str().into(),
                    verdict,
                    finding.rests_on().into(),
                    found,
                ]
            }));
        }
        table
    }

    /// Each rule with the claims that are judged by it.
    pub(crate) fn rules(&self) -> Vec<(String, String)> {
        let mut rules: Vec<(String, String)> = Vec::new();
        for Entry { claim, .. } in &self.entries {
            let rule = claim.check.rule();
            match rules.iter_mut().find(|(_, known)| *known == rule) {
                Some((ids, _)) => ids.push_str(&format!(", {}", claim.id)),
                None => rules.push((claim.id.clone(), rule)),
            }
        }
        rules
    }
}
