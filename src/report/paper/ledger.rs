//! The ledger: each claim of the paper beside what its own tables and each measured device say.

use anyhow::{Context as _, Result};

use super::claims::Claim;
use super::evidence::{Evidence, Finding, Verdict};
use super::published::Publication;
use super::sheet::Sheet;
use crate::report::groups::Group;
use crate::report::table::{Cell, Column, Table, escape};
use crate::table::text_under;

const HEAD: &str =
    "claim,text,claimed,source,device,software,verdict,value,unit,found,pairs,pairs_of,wrong_masks";
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
    pub findings: Vec<(String, Finding)>,
}

impl Ledger {
    pub(super) fn new(
        paper: &'static Publication,
        sheets: &[Sheet],
        groups: &[Group<'_>],
    ) -> Result<Self> {
        let mut measurers = vec![(None, "The paper's own tables".to_owned())];
        let groups = groups.iter().enumerate();
        measurers.extend(
            groups
                .clone()
                .map(|(index, group)| (Some(index), group.label.clone())),
        );
        let entry = |claim: &'static Claim| {
            let find = |(group, device): &(Option<usize>, String)| {
                let group = *group;
                let mut found = claim.check.find(&Evidence { sheets, group })?;
                if group.is_none() {
                    found.verdict = Verdict::None;
                }
                Ok((device.clone(), found))
            };
            let findings = measurers.iter().map(find).collect::<Result<_>>();
            let findings =
                findings.with_context(|| format!("cannot check the claim {}", claim.id))?;
            Ok(Entry { claim, findings })
        };
        let software = groups.filter(|(_, group)| group.software);
        Ok(Self {
            entries: paper.claims.iter().map(entry).collect::<Result<_>>()?,
            software: software.map(|(_, group)| group.label.clone()).collect(),
        })
    }

    pub(crate) fn csv(&self) -> Result<String> {
        let mut rows = Vec::new();
        for Entry { claim, findings } in &self.entries {
            for (device, finding) in findings {
                let is_own = finding.verdict == Verdict::None;
                rows.push((
                    (&claim.id, &claim.text, &claim.claimed),
                    if is_own { "paper" } else { "measured" },
                    device,
                    !is_own && self.software.contains(device),
                    finding.verdict.word(),
                    (finding.value, finding.unit, &finding.text),
                    (finding.pairs, finding.pairs_of, finding.wrong_masks),
                ));
            }
        }
        Ok(String::from_utf8(text_under(
            HEAD.split(',').collect(),
            &rows,
        )?)?)
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
            table = table.extend(findings.iter().map(|(device, finding)| {
                let verdict = Cell::from(finding.verdict.word()).class(match finding.verdict {
                    Verdict::Reproduced => "verdict held",
                    Verdict::TrendOnly => "verdict trend",
                    Verdict::NotReproduced => "verdict broken",
                    Verdict::NotMeasured => "verdict quiet",
                    Verdict::None => "",
                });
                let mut found = Cell::from(finding.text.as_str());
                if finding.verdict == Verdict::None && !claim.note.is_empty() {
                    found = found.small(&claim.note);
                }
                [
                    device.as_str().into(),
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
