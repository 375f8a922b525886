//! The ledger: each claim of the paper beside what its own tables and each measured device say.

use anyhow::{Context as _, Result};
use serde::Serialize;

use super::claims::Claim;
use super::evidence::Evidence;
use super::finding::{Finding, Verdict};
use super::published::Publication;
use super::sheet::{Sheet, Source};
use crate::report::groups::Group;
use crate::report::table::{Cell, Column, Table, escape};
use crate::table::text;

/// Whose numbers a row of the ledger is about, where they are the paper's.
const OWN_TABLES: &str = "The paper's own tables";
/// What the ledger says of a software device.
pub const SOFTWARE_NOTE: &str = "renders in software: its times say nothing about GPUs, and neither \
    do its verdicts.";

/// The claims and what became of them.
#[derive(Debug)]
pub struct Ledger {
    /// In the order of the paper's file.
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
    pub(super) fn new(paper: &Publication, sheets: &[Sheet], groups: &[Group<'_>]) -> Result<Self> {
        let entry = |claim: &Claim| {
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
                claim: claim.clone(),
            })
        };
        let software = groups.iter().filter(|group| group.software);
        Ok(Self {
            entries: paper.claims.iter().map(entry).collect::<Result<_>>()?,
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

    /// The ledger as a Markdown document.
    pub fn markdown(&self) -> String {
        let software = self.software.iter();
        let software = software.map(|device| format!("**{}** {SOFTWARE_NOTE}\n\n", escape(device)));
        let (software, rules) = (software.collect::<String>(), self.rules());
        let rules = rules.iter().map(|(ids, rule)| format!("- {ids}: {rule}\n"));
        let (rules, table) = (rules.collect::<String>(), self.table().markdown());
        format!("# The paper's claims\n\n{software}{table}\n## How verdicts are reached\n\n{rules}")
    }

    /// The claims as groups of rows, a row a measurer.
    pub fn table(&self) -> Table {
        let heads = [
            ("Device", ""),
            ("Verdict", ""),
            ("Rests on", ""),
            ("Found", "found"),
        ];
        let columns = heads.map(|(head, class)| Column::text(head).class(class));
        let mut table = Table::new("The paper's claims", columns).class("ledger");
        for entry in &self.entries {
            let claim = &entry.claim;
            let wide = maud::html! {
                (claim.text) span.quiet { " Claimed: " (claim.claimed) ". " code { (claim.id) } }
            };
            let claimed = format!("claimed: {}", claim.claimed);
            let plain = [
                Cell::strong(&claim.text),
                "".into(),
                "".into(),
                claimed.into(),
            ];
            table.begin(Cell::drawn(wide), plain.to_vec());
            let found = Cell::from(entry.paper.text.as_str());
            let found = if claim.note.is_empty() {
                found
            } else {
                found.small(&claim.note)
            };
            let rests_on = entry.paper.rests_on().into();
            table.push([OWN_TABLES.into(), "".into(), rests_on, found]);
            table = table.extend(entry.devices.iter().map(|(device, finding)| {
                let verdict = Cell::from(finding.verdict.word()).class(match finding.verdict {
                    Verdict::Reproduced => "verdict held",
                    Verdict::TrendOnly => "verdict trend",
                    Verdict::NotReproduced => "verdict broken",
                    Verdict::NotMeasured => "verdict quiet",
                });
                let (rests_on, found) = (finding.rests_on().into(), finding.text.as_str().into());
                [device.as_str().into(), verdict, rests_on, found]
            }));
        }
        table
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
