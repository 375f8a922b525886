//! The ledger: each claim of the paper beside what its own tables and each measured device say.

use anyhow::{Context as _, Result};
use serde::Serialize;

use super::check::{Finding, Verdict};
use super::claims::{Claim, claims};
use super::evidence::Evidence;
use super::sheet::{Sheet, Source};
use crate::report::groups::Group;
use crate::report::markdown::{align, escape};
use crate::table::text;

/// Whose numbers a row of the ledger is about, where they are the paper's.
pub const OWN_TABLES: &str = "The paper's own tables";
/// What the ledger says of a software device.
pub const SOFTWARE_NOTE: &str = "renders in software: its times say nothing about GPUs, and neither \
    do its verdicts.";

/// The claims and what became of them.
#[derive(Debug)]
pub struct Ledger {
    /// In the order of the claims file.
    pub entries: Vec<Entry>,
    /// The measured devices that render in software.
    pub software: Vec<String>,
}

/// One claim.
#[derive(Debug)]
pub struct Entry {
    /// What the paper says.
    pub claim: Claim,
    /// What its own tables give. Their verdict is left out: a verdict is about a repetition.
    pub paper: Finding,
    /// What each measured device gives.
    pub devices: Vec<(String, Finding)>,
}

/// A row of `ledger.csv`.
#[derive(Debug, Serialize)]
struct Row<'a> {
    claim: &'a str,
    text: &'a str,
    claimed: &'a str,
    source: &'static str,
    device: &'a str,
    software: bool,
    verdict: &'static str,
    value: Option<f64>,
    unit: &'static str,
    found: &'a str,
    pairs: usize,
    pairs_of: usize,
    wrong_masks: usize,
}

impl Ledger {
    pub(super) fn new(sheets: &[Sheet], groups: &[Group<'_>]) -> Result<Self> {
        let entry = |claim: Claim| {
            let find = |source| {
                let found = claim.check.find(&Evidence { sheets, source });
                found.with_context(|| format!("cannot check the claim {}", claim.id))
            };
            let paper = find(Source::Paper)?;
            let devices = groups
                .iter()
                .enumerate()
                .map(|(index, group)| Ok((group.label.clone(), find(Source::Measured(index))?)))
                .collect::<Result<_>>()?;
            Ok(Entry {
                paper,
                devices,
                claim,
            })
        };
        let software = groups.iter().filter(|group| group.software);
        Ok(Self {
            entries: claims()?.into_iter().map(entry).collect::<Result<_>>()?,
            software: software.map(|group| group.label.clone()).collect(),
        })
    }

    /// The ledger as CSV, a row for each claim and measurer.
    pub fn csv(&self) -> Result<String> {
        let mut rows = Vec::new();
        for Entry {
            claim,
            paper,
            devices,
        } in &self.entries
        {
            rows.push(Row {
                verdict: "",
                ..self.row(claim, "paper", OWN_TABLES, paper)
            });
            for (device, finding) in devices {
                rows.push(self.row(claim, "measured", device, finding));
            }
        }
        Ok(String::from_utf8(text(&rows)?)?)
    }

    fn row<'a>(
        &self,
        claim: &'a Claim,
        source: &'static str,
        device: &'a str,
        finding: &'a Finding,
    ) -> Row<'a> {
        Row {
            claim: &claim.id,
            text: &claim.text,
            claimed: &claim.claimed,
            source,
            device,
            software: source == "measured" && self.software.iter().any(|name| name == device),
            verdict: finding.verdict.word(),
            value: finding.value,
            unit: finding.unit,
            found: &finding.text,
            pairs: finding.pairs,
            pairs_of: finding.pairs_of,
            wrong_masks: finding.wrong_masks,
        }
    }

    /// The ledger as Markdown.
    pub fn markdown(&self) -> String {
        let head = ["Claim", "Verdict", "Rests on", "Found"].map(str::to_owned);
        let mut rows = vec![head.to_vec()];
        for Entry {
            claim,
            paper,
            devices,
        } in &self.entries
        {
            let title = format!("**{}**", escape(&claim.text));
            let claimed = format!("claimed: {}", escape(&claim.claimed));
            rows.push(vec![title, String::new(), String::new(), claimed]);
            let found = [paper.text.as_str(), claim.note.as_str()];
            let found = found.into_iter().filter(|part| !part.is_empty());
            let found = found.collect::<Vec<_>>().join(". ");
            let own = vec![OWN_TABLES.to_owned(), String::new(), rests_on(paper), found];
            rows.push(own);
            rows.extend(devices.iter().map(|(device, finding)| {
                vec![
                    escape(device),
                    finding.verdict.word().to_owned(),
                    rests_on(finding),
                    escape(&finding.text),
                ]
            }));
        }
        let software = self.software.iter();
        let software: String = software
            .map(|device| format!("**{}** {SOFTWARE_NOTE}\n\n", escape(device)))
            .collect();
        let rules: String = self
            .rules()
            .iter()
            .map(|(ids, rule)| format!("- {ids}: {rule}\n"))
            .collect();
        let table = align(&rows, &[0, 1, 2, 3]);
        format!("# The paper's claims\n\n{software}{table}\n## How verdicts are reached\n\n{rules}")
    }

    /// Each rule with the claims that are judged by it.
    pub fn rules(&self) -> Vec<(String, String)> {
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

/// How much a finding rests on, and how much of that is doubtful.
pub fn rests_on(finding: &Finding) -> String {
    let Finding {
        pairs,
        pairs_of,
        wrong_masks,
        ..
    } = finding;
    if finding.verdict == Verdict::NotMeasured && *pairs == 0 {
        return format!("0 of {pairs_of}");
    }
    match wrong_masks {
        0 => format!("{pairs} of {pairs_of}"),
        wrong => format!("{pairs} of {pairs_of}, {wrong} with a wrong mask"),
    }
}
