//! Which contenders the plots of times show, and what each looks like there.
//!
//! A run with sweeps has dozens of contenders, more than lines are told apart. With more than
//! [`EASY`], a sweep is shown by its two ends alone; of what is left, the first [`MOST`] in the run's
//! order. A plot that leaves any out says so in its title; all of them are in the tables.

use super::canvas::Style;
use crate::report::curve::{Contender, Curves};
use crate::report::load::Run;

/// So many fit beside a plot of the usual height.
const EASY: usize = 14;
/// More than this many lines are a tangle.
const MOST: usize = 24;

#[derive(Debug)]
pub(super) struct Chosen {
    /// What each looks like. Those of one curve share its colour and differ in their markers.
    pub(super) keys: Vec<(Style, Contender)>,
    /// What is added to a plot's title: how many of how many, where not all.
    pub(super) remark: String,
}

impl Chosen {
    pub(super) fn of(run: &Run) -> Self {
        let curves = Curves::of(run);
        let all = curves.members.len();
        let mut shown: Vec<usize> = (0..all).collect();
        if all > EASY {
            shown.retain(|index| is_end(&curves, *index));
        }
        shown.truncate(MOST);
        let remark = if shown.len() < all {
            format!(" ({} of {all} contenders)", shown.len())
        } else {
            String::new()
        };
        let mut of_curve = vec![0; curves.all.len()];
        let keys = shown.into_iter().map(|index| {
            let (contender, place, _) = &curves.members[index];
            let marker = Some(place + of_curve[*place]);
            of_curve[*place] += 1;
            let style = Style::of(*place);
            (Style { marker, ..style }, contender.clone())
        });
        Self {
            keys: keys.collect(),
            remark,
        }
    }
}

/// Whether a contender is no point of a sweep, or has its least or greatest value.
fn is_end(curves: &Curves, index: usize) -> bool {
    let (_, place, value) = &curves.members[index];
    let Some(value) = value else { return true };
    let on_curve = curves.members.iter().filter(|(_, other, _)| other == place);
    let values: Vec<f64> = on_curve.filter_map(|(_, _, value)| *value).collect();
    values.iter().all(|other| other >= value) || values.iter().all(|other| other <= value)
}

#[cfg(test)]
mod tests {
    use super::Chosen;
    use crate::report::fixture::swept_run;
    use crate::report::load::Run;

    #[test]
    fn of_many_contenders_sweeps_show_their_ends_in_one_colour() {
        let dir = swept_run();
        let run = Run::read(dir.path()).unwrap();
        let all = Chosen::of(&run);
        let names: Vec<String> = all.keys.iter().map(|(_, who)| who.label()).collect();
        assert!(run.contenders().len() > super::EASY, "{names:?}");
        assert!(
            names.contains(&"shadow_map resolution=512".to_owned()),
            "{names:?}"
        );
        assert!(
            names.contains(&"shadow_map resolution=8192".to_owned()),
            "{names:?}"
        );
        assert!(
            !names.contains(&"shadow_map resolution=2048".to_owned()),
            "{names:?}"
        );
        let count = format!(
            " ({} of {} contenders)",
            names.len(),
            run.contenders().len()
        );
        assert_eq!(all.remark, count);
        let ends: Vec<_> = all
            .keys
            .iter()
            .filter(|(_, who)| who.variant.starts_with("resolution="))
            .map(|(key, _)| key)
            .collect();
        assert_eq!(ends[0].color, ends[1].color);
        assert_ne!(ends[0].marker, ends[1].marker);
    }
}
