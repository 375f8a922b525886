//! The lists as people read them.

use super::{Listing, MethodRow, SceneRow};
use crate::gpu::{Capability, DeviceSummary};
use crate::methods::{Effect, Limit};
use crate::record::stress::CauseRecord;
use std::fmt::Display;

/// All that was asked for, one below the other.
pub(super) fn of(listing: &Listing<'_>) -> String {
    let mut text = Text::default();
    let Listing {
        methods,
        scenes,
        causes,
        devices,
    } = listing;
    methods.iter().flatten().for_each(|row| text.method(row));
    scenes.iter().flatten().for_each(|row| text.scene(row));
    causes.iter().flatten().for_each(|row| text.cause(row));
    devices.iter().flatten().for_each(|row| text.device(row));
    text.0
}

/// Lines, indented below what they are about.
#[derive(Default)]
struct Text(String);

impl Text {
    fn title(&mut self, line: impl Display) {
        self.0.push_str(&format!("{line}\n"));
    }

    fn about(&mut self, line: impl Display) {
        self.0.push_str(&format!("    {line}\n"));
    }

    fn detail(&mut self, line: impl Display) {
        self.0.push_str(&format!("        {line}\n"));
    }

    fn availability(&mut self, available: bool, reason: &str) {
        match available {
            true => self.about("available"),
            false => self.about(format!("not available: {reason}")),
        }
    }

    fn method(&mut self, row: &MethodRow<'_>) {
        let info = row.info;
        self.title(format!("{}  {}", info.id, info.title));
        self.about(format!("from: {}", info.source));
        let needs = match info.needs {
            [] => "nothing special".to_owned(),
            needs => words(needs),
        };
        self.about(format!("needs: {needs}"));
        for limit in info.limits.iter().copied().flatten() {
            self.about(format!("limit: {}", limit.text));
            limit_details(limit)
                .iter()
                .for_each(|line| self.detail(line));
        }
        for parameter in row.parameters {
            let (name, default) = (parameter.name, parameter.default_text());
            let domain = &parameter.domain;
            self.about(format!("parameter: {name} = {default} ({domain})"));
            self.detail(&parameter.words);
        }
        for clash in &row.clashes {
            let parameters = clash.parameters.join(", ");
            let effect = match clash.effect {
                Effect::Refused => "cannot be set as well",
                Effect::Ignored => "makes no difference",
            };
            self.about(format!("beside {}: {parameters} {effect}", clash.beside));
            self.detail(clash.why);
        }
        self.availability(row.available, &row.reason);
    }

    fn scene(&mut self, row: &SceneRow) {
        self.title(format!("{}  {}", row.name, row.title));
        let count = |count: Option<u64>| count.map_or("?".to_owned(), |count| count.to_string());
        let (triangles, objects) = (count(row.triangles), count(row.objects));
        let mesh = &row.mesh;
        self.about(format!("{mesh}: {triangles} triangles, {objects} objects"));
        self.availability(row.available, &row.reason);
    }

    fn cause(&mut self, row: &CauseRecord) {
        self.title(format!("{}  {}", row.id, row.title));
        let values: Vec<_> = row.values.iter().map(f64::to_string).collect();
        self.about(format!("{}: {}", row.number, values.join(", ")));
        self.about(&row.why);
    }

    fn device(&mut self, device: &DeviceSummary) {
        let DeviceSummary {
            name,
            device_type,
            backend,
            ..
        } = device;
        self.title(format!("{name}  {device_type}, {backend}"));
        self.about(format!("driver: {} {}", device.driver, device.driver_info));
        let (has, lacks): (Vec<Capability>, Vec<_>) = Capability::ALL
            .iter()
            .partition(|capability| device.capabilities.contains(capability));
        for (verb, capabilities) in [("has", has), ("lacks", lacks)] {
            if !capabilities.is_empty() {
                self.about(format!("{verb}: {}", words(&capabilities)));
            }
        }
        let reason = (device.unsuitable.as_ref()).map(|missing| format!("lacks {missing}"));
        self.availability(reason.is_none(), &reason.unwrap_or_default());
    }
}

fn words(capabilities: &[Capability]) -> String {
    let words: Vec<_> = capabilities
        .iter()
        .map(|capability| capability.words())
        .collect();
    words.join("; ")
}

/// What a limit says besides its text: where it shows, as what, and how much of it there may be.
fn limit_details(limit: &Limit) -> Vec<String> {
    let fails = limit.fails.iter();
    let causes: Vec<_> = fails
        .map(|(cause, from)| format!("{cause} from {from}"))
        .collect();
    let kinds: Vec<_> = limit.kinds.iter().map(|kind| kind.word()).collect();
    let mut details = Vec::new();
    if !causes.is_empty() {
        details.push(format!("causes: {}", causes.join(", ")));
    }
    if !kinds.is_empty() {
        details.push(format!("kinds of error: {}", kinds.join(", ")));
    }
    if !details.is_empty() {
        details.push(format!("at most: {}", limit.at_most));
    }
    details
}
