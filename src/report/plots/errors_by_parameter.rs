//! Wrong pixels against a swept parameter: what a value costs or buys in accuracy alone.

use super::Figure;
use super::axis::Axis;
use super::canvas::{INK, Style};
use super::chart::{Chart, Line};
use super::pareto::on_curve;
use crate::file_name::file_name;
use crate::report::curve::{Contender, Curves};
use crate::report::load::{Run, unique};
use crate::report::pareto::{Cloud, Point};

/// How the name of each of these plots begins.
pub(in crate::report) const PREFIX: &str = "errors_by_";
/// Fewer values than this are no curve.
const FEWEST: usize = 3;
/// Dashes of the lines of artifacts.
const DASH_PX: i32 = 5;

pub(super) fn figures(run: &Run, clouds: &[Cloud]) -> Vec<Figure> {
    let curves = Curves::of(run);
    let mut figures: Vec<Figure> = Vec::new();
    for cloud in clouds {
        let Some(scene) = &cloud.scene else { continue };
        let sweeps = cloud.points.iter().filter_map(|point| point.sweep.as_ref());
        for parameter in unique(sweeps.map(|sweep| &*sweep.parameter)) {
            let Some(chart) = chart(cloud, &curves, parameter) else {
                continue;
            };
            let mut name = format!("{PREFIX}{}_{}", file_name(parameter), file_name(scene));
            // Where a parameter ends and a scene begins, the name does not say.
            while figures.iter().any(|other| other.name == name) {
                name.push('-');
            }
            figures.push(Figure {
                name,
                title: format!("Wrong pixels by {parameter}, {}", run.scene_title(scene)),
                chart,
            });
        }
    }
    figures
}

/// Lines of wrong pixels and, dashed, of the artifacts among them, for each curve of the parameter.
fn chart(cloud: &Cloud, curves: &Curves, parameter: &str) -> Option<Chart> {
    let (mut lines, mut legend) = (Vec::new(), Vec::new());
    for (place, curve) in curves.all.iter().enumerate() {
        let points = on_curve(&cloud.points, curve);
        if curve.parameter.as_deref() != Some(parameter) || points.len() < FEWEST {
            continue;
        }
        let line = |style, px: fn(&Point) -> f64| Line {
            style,
            points: points
                .iter()
                .map(|(value, point)| (*value, px(point)))
                .collect(),
        };
        let style = Style::of(place);
        lines.push(line(style.dashed(DASH_PX), artifacts_per_frame));
        lines.push(line(style, |point| point.wrong_px));
        legend.push((style, curve.name.clone()));
    }
    let (black, artifacts) = (Style::line(INK, 2), "farther than 1 px from the edge");
    legend.push((black, Contender::new("wrong pixels", "all")));
    legend.push((
        black.dashed(DASH_PX),
        Contender::new("artifacts", artifacts),
    ));
    let y = ("Pixels per verified frame, mean", Axis::log as _);
    (!lines.is_empty()).then(|| Chart::of_lines((parameter, Axis::spread), y, lines, legend))
}

fn artifacts_per_frame(point: &Point) -> f64 {
    point.counts.artifact_px as f64 / f64::from(point.counts.verified_frames.max(1))
}
