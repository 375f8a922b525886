//! Advice as people read it.

use super::{Advice, FULL, Measured, Overdraw, Shape};
use crate::frame::DrawnVolumes;
use std::fmt::{Display, Formatter, Result};

/// A saving of less than this part is not worth a word.
const WORTH_A_WORD: f64 = 1.1;

impl Display for Advice {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        writeln!(f, "{}", self.scene)?;
        self.shape.write(f)?;
        let (width, height) = self.size_px;
        let planned = self.picks().into_iter().chain(&self.measured);
        let mut with_plan = planned.filter(|method| method.method.contains("plan=auto"));
        if let Some((method, drawn)) = with_plan.find_map(|m| Some((&m.method, m.drawn?))) {
            writeln!(
                f,
                "\nthe plan of {method}: objects a frame, mean of {}",
                counted(self.frames, "moment")
            )?;
            write_plan(f, drawn, self.frames)?;
        }
        writeln!(
            f,
            "\nmeasured on {} at {width} × {height}\n    \
             shadow time: median of {}, processor included, without G-buffer and shading; ratio to {FULL} (whole volumes, z-fail, \
             with caps) frame by frame: median, and the middle half\n    \
             wrong pixels: mean of {} against a ray-traced truth; artifacts are those away from true boundaries; exact: at most \
             one artifact a frame, or no more than {FULL}",
            self.device,
            counted(self.frames, "frame"),
            counted(self.verified, "frame")
        )?;
        self.write_measured(f)?;
        writeln!(f, "\n{}", self.advice())
    }
}

/// So many things.
fn counted(count: usize, what: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {what}{ending}")
}

impl Shape {
    fn write(&self, f: &mut Formatter<'_>) -> Result {
        let Self {
            triangles,
            objects,
            closed_objects,
            closed_triangles,
            left_out,
            edges,
            open_edges,
            overdraw,
        } = self;
        let percent = |part: usize, all: usize| 100.0 * part as f64 / all.max(1) as f64;
        let closed = percent(*closed_triangles, *triangles);
        let all_edges = edges.boundary + edges.manifold + edges.non_manifold;
        writeln!(
            f,
            "    {} of {} cast",
            counted(*triangles, "triangle"),
            counted(*objects, "object")
        )?;
        writeln!(
            f,
            "    closed: {}, {closed:.0} % of the triangles",
            counted(*closed_objects, "object")
        )?;
        match left_out {
            Some(left_out) => writeln!(
                f,
                "    occluded: the plan leaves out {left_out} triangles ({:.0} %) that others hide from the light",
                percent(*left_out, *triangles)
            )?,
            None => writeln!(f, "    occluded: none is left out, for the light moves")?,
        }
        writeln!(
            f,
            "    edges: {} of one triangle, {} of two, {} of more; surfaces end at {:.1} % (open edges)",
            edges.boundary,
            edges.manifold,
            edges.non_manifold,
            percent(*open_edges, all_edges)
        )?;
        let Overdraw {
            infinity,
            scene,
            object,
        } = overdraw;
        writeln!(
            f,
            "    layers of side quads of whole volumes, mean over the picture:\n        \
             {infinity:.1} if they reach to infinity\n        \
             {scene:.1} if all end on one plane beside the scene (reach=scene){}\n        \
             {object:.1} if each object's end on a plane of its own (reach=object)",
            if scene == infinity {
                ", but there is no such plane"
            } else {
                ""
            }
        )
    }
}

fn write_plan(f: &mut Formatter<'_>, drawn: DrawnVolumes, frames: usize) -> Result {
    let a_frame = |objects: u32| f64::from(objects) / frames as f64;
    let DrawnVolumes {
        culled,
        hidden,
        queries: _,
        z_pass,
        z_pass_counted,
        z_fail,
        light_facing,
        each_side,
        all,
        at_infinity,
    } = drawn;
    let counted = [
        (
            culled,
            "not drawn: nothing of them is left to cast, or it shadows nothing in view",
        ),
        (
            hidden,
            "not drawn: hidden, as boxes around their volumes are",
        ),
        (z_pass, "counted z-pass, without caps"),
        (
            z_pass_counted,
            "  of these with the eye inside; a ray to the light counts how often",
        ),
        (z_fail, "counted z-fail, with caps"),
    ];
    let cast = [
        (
            light_facing,
            "closed: their light-facing triangles cast, with half the side quads",
        ),
        (
            each_side,
            "nearly closed: the same, and then side quads of their open edges",
        ),
        (all, "with too many open edges for that: all triangles cast"),
    ];
    let ends = [(
        at_infinity,
        "reach to infinity, for no plane beside the scene will do",
    )];
    for (title, lines) in [
        ("volumes", &counted[..]),
        ("of those drawn, what casts", &cast),
        ("of those drawn, where they end", &ends),
    ] {
        if lines.iter().all(|(count, _)| *count == 0) {
            continue;
        }
        writeln!(f, "    {title}")?;
        for &(count, what) in lines.iter().filter(|(count, _)| *count > 0) {
            writeln!(f, "{:>12.1}  {what}", a_frame(count))?;
        }
    }
    Ok(())
}

impl Advice {
    fn full(&self) -> Option<&Measured> {
        self.measured.iter().find(|method| method.method == FULL)
    }

    /// Pixels of all verified frames as a mean.
    fn a_frame(&self, px: u64) -> f64 {
        px as f64 / self.verified.max(1) as f64
    }

    fn write_measured(&self, f: &mut Formatter<'_>) -> Result {
        let widest = self.measured.iter().map(|method| method.method.len());
        let name_width = widest.max().unwrap_or(0);
        writeln!(
            f,
            "    {:name_width$}  {:>9}  {:>5}  {:>9}  {:>8}  {:>11}  exact",
            "method", "shadow ms", "ratio", "half", "wrong px", "artifact px"
        )?;
        for measured in &self.measured {
            let method = &measured.method;
            let Some([_, median_ms, _]) = measured.quartiles_ms() else {
                let reason = measured.shadow_ms.as_ref().err();
                let reason = reason.map_or("no frame", |reason| reason);
                writeln!(f, "    {method:name_width$}  {reason}")?;
                continue;
            };
            let ratio = self
                .full()
                .and_then(|full| measured.quartiles_of_ratio(full));
            let [ratio, half] = match ratio {
                Some([low, ratio, high]) => [format!("{ratio:.2}"), format!("{low:.2}–{high:.2}")],
                None => Default::default(),
            };
            let [wrong, artifact] =
                [measured.wrong_px, measured.artifact_px].map(|px| self.a_frame(px));
            let is_exact = if self.is_exact(measured) { "yes" } else { "no" };
            writeln!(
                f,
                "    {method:name_width$}  {median_ms:>9.1}  {ratio:>5}  {half:>9}  {wrong:>8.1}  {artifact:>11.1}  {is_exact}"
            )?;
        }
        Ok(())
    }

    /// Which method, and why.
    fn advice(&self) -> String {
        let picks = self.picks();
        let Some((pick, alike)) = picks.split_first() else {
            return "advice: none; no method is exact here".to_owned();
        };
        let gain = self.full().and_then(|full| full.quartiles_of_ratio(pick));
        if picks.iter().any(|method| method.method == FULL) {
            return format!(
                "advice: any exact method; none is clearly faster than {FULL}{}",
                self.faster_than(pick)
            );
        }
        let mut advice = format!("advice: {}", pick.method);
        if let Some([_, gain, _]) = gain {
            advice.push_str(&format!(", {gain:.1} times as fast as {FULL}"));
        }
        if !alike.is_empty() {
            let names: Vec<_> = alike.iter().map(|method| &*method.method).collect();
            advice.push_str(&format!(
                "\nor, as fast within a tenth: {}",
                names.join("; ")
            ));
        }
        let reasons = self.reasons(pick);
        if !reasons.is_empty() {
            advice.push_str(&format!(
                "\nwhat its plan finds here:\n    {}",
                reasons.join("\n    ")
            ));
        }
        advice + &self.faster_than(pick)
    }

    /// Names what is faster and not exact.
    fn faster_than(&self, pick: &Measured) -> String {
        let faster = self.measured.iter().find(|method| {
            let ratio = method.quartiles_of_ratio(pick);
            ratio.is_some_and(|[_, ratio, _]| ratio < 1.0) && !self.is_exact(method)
        });
        faster.map_or(String::new(), |faster| {
            format!(
                "\nfaster, if some {:.0} wrong pixels a frame do not matter: {}",
                self.a_frame(faster.wrong_px),
                faster.method
            )
        })
    }

    fn reasons(&self, pick: &Measured) -> Vec<String> {
        let has_plan = pick.method.contains("plan=auto");
        let Some(drawn) = pick.drawn.filter(|_| has_plan) else {
            return Vec::new();
        };
        let objects = drawn.z_pass + drawn.z_fail;
        let share = |part: u32| f64::from(part) / f64::from(objects.max(1));
        let mut reasons = Vec::new();
        let percent = |part: u32| format!("{:.0} %", 100.0 * share(part));
        if share(drawn.z_pass) > 0.5 {
            let share = percent(drawn.z_pass);
            reasons.push(format!("{share} of the volumes drawn need no caps"));
        }
        if share(drawn.light_facing) > 0.1 {
            reasons.push(format!(
                "{} are of closed objects, with half the side quads",
                percent(drawn.light_facing)
            ));
        }
        if share(drawn.each_side) > 0.1 {
            reasons.push(format!(
                "{} are of nearly closed objects: only side quads of open edges are drawn twice",
                percent(drawn.each_side)
            ));
        }
        if share(drawn.all) > 0.5 {
            reasons.push(format!(
                "{} are of objects with too many open edges to leave triangles out",
                percent(drawn.all)
            ));
        }
        let left_out = self.shape.left_out.unwrap_or(0) as f64 / self.shape.triangles.max(1) as f64;
        if left_out > 0.1 {
            reasons.push(format!(
                "{:.0} % of all triangles are hidden from the light by others, and need not cast",
                100.0 * left_out
            ));
        }
        let Overdraw { scene, object, .. } = self.shape.overdraw;
        if object > 0.0 && scene / object > WORTH_A_WORD {
            reasons.push(format!(
                "side quads that end object by object cover {:.0} % less of the picture",
                100.0 * (1.0 - object / scene)
            ));
        }
        if drawn.culled > 0 && f64::from(drawn.culled) > 0.1 * f64::from(objects) {
            reasons.push(format!(
                "{:.0} objects a frame need no volume at all",
                f64::from(drawn.culled) / self.frames as f64
            ));
        }
        reasons
    }
}

#[cfg(test)]
#[path = "text_tests.rs"]
mod tests;
