//! Advice as people read it.

use super::{Advice, FULL, Measured, Overdraw, Shape};
use crate::frame::DrawnVolumes;
use std::fmt::{Display, Formatter, Result};

/// A saving of less than this part is not worth a word.
const WORTH_A_WORD: f64 = 1.1;

/// A method that is faster by less may be so by chance.
const WORTH_THE_CHANGE: f64 = 1.25;

impl Display for Advice {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        writeln!(f, "{}", self.scene)?;
        self.shape.write(f)?;
        let (width, height) = self.size_px;
        let planned = self
            .pick()
            .map(|(pick, _)| pick)
            .into_iter()
            .chain(&self.measured);
        let mut with_plan = planned.filter(|method| method.method.contains("plan=auto"));
        if let Some((method, drawn)) = with_plan.find_map(|m| Some((&m.method, m.drawn?))) {
            let frames = self.frames;
            writeln!(
                f,
                "\nthe plan of {method}, objects a frame at {frames} moments of the flight"
            )?;
            write_plan(f, drawn, frames)?;
        }
        writeln!(
            f,
            "\nmeasured on {} at {width} × {height}: median shadow time of {} frames, with all that is found on the processor; \
             pixels of {} frames together, against a ray-traced truth\n\
             {FULL} draws whole volumes, z-fail, with caps; artifacts are wrong pixels away from true boundaries",
            self.device, self.frames, self.verified
        )?;
        self.write_measured(f)?;
        writeln!(f, "\n{}", self.advice())
    }
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
        writeln!(f, "    {triangles} triangles of {objects} objects cast")?;
        writeln!(
            f,
            "    closed: {closed_objects} objects, {closed:.0} % of the triangles"
        )?;
        match left_out {
            Some(left_out) => writeln!(
                f,
                "    occluded: the plan leaves out {left_out} triangles ({:.0} %) that the light never reaches",
                percent(*left_out, *triangles)
            )?,
            None => writeln!(f, "    occluded: not asked, since the light moves")?,
        }
        writeln!(
            f,
            "    edges: {} of one triangle, {} of two, {} of more; {:.1} % are open",
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
            "    side quads of whole volumes cover a pixel {infinity:.1} times if they reach to infinity, {scene:.1} times if all \
             are cut on one plane beside the scene (as without a plan), {object:.1} times if each object's are cut on its own"
        )
    }
}

fn write_plan(f: &mut Formatter<'_>, drawn: DrawnVolumes, frames: usize) -> Result {
    let a_frame = |objects: u32| f64::from(objects) / frames as f64;
    let DrawnVolumes {
        culled,
        z_pass,
        z_pass_counted,
        z_fail,
        light_facing,
        each_side,
        all,
        at_infinity,
    } = drawn;
    for (count, what) in [
        (culled, "not drawn: they cannot shadow anything in view"),
        (z_pass, "counted z-pass, which needs no caps"),
        (
            z_pass_counted,
            "    with the eye in them: a ray counts how often",
        ),
        (z_fail, "counted z-fail, with caps"),
        (
            light_facing,
            "closed: only their light-facing triangles cast, in half the side quads",
        ),
        (
            each_side,
            "nearly closed: light-facing triangles cast first, the rest by open edges, in fewer side quads",
        ),
        (all, "too open for that: all triangles cast"),
        (
            at_infinity,
            "volumes that cannot be cut, and reach to infinity",
        ),
    ] {
        if count > 0 {
            writeln!(f, "{:>10.1}  {what}", a_frame(count))?;
        }
    }
    Ok(())
}

impl Advice {
    fn full_ms(&self) -> Option<f64> {
        let full = self.measured.iter().find(|method| method.method == FULL)?;
        full.shadow_ms.clone().ok()
    }

    fn write_measured(&self, f: &mut Formatter<'_>) -> Result {
        let widest = self.measured.iter().map(|method| method.method.len());
        let name_width = widest.max().unwrap_or(0);
        writeln!(
            f,
            "    {:name_width$}  {:>9}  {:>7}  {:>8}  {:>9}",
            "method", "shadow ms", "ratio", "wrong px", "artifacts"
        )?;
        for Measured {
            method,
            shadow_ms,
            wrong_px,
            artifact_px,
            ..
        } in &self.measured
        {
            match shadow_ms {
                Ok(ms) => {
                    let share = self
                        .full_ms()
                        .map_or(String::new(), |full| format!("{:.2}", ms / full));
                    writeln!(
                        f,
                        "    {method:name_width$}  {ms:>9.1}  {share:>7}  {wrong_px:>8}  {artifact_px:>9}"
                    )?;
                }
                Err(reason) => writeln!(f, "    {method:name_width$}  {reason}")?,
            }
        }
        Ok(())
    }

    /// Which method, and why.
    fn advice(&self) -> String {
        let Some((pick, ms)) = self.pick() else {
            return "advice: none; no method drew this scene with one artifact pixel a frame or less".to_owned();
        };
        let mut advice = format!("advice: {}", pick.method);
        if let Some(full) = self.full_ms().filter(|_| pick.method != FULL) {
            let gain = full / ms;
            advice.push_str(&format!(", {gain:.1} times as fast as {FULL}"));
            if gain < WORTH_THE_CHANGE {
                advice.push_str(", which is little");
            }
        }
        let reasons = self.reasons(pick);
        if !reasons.is_empty() {
            advice.push_str(&format!(":\n    {}", reasons.join(";\n    ")));
        }
        let faster = self.measured.iter().find(|method| {
            let is_faster = method.shadow_ms.as_ref().is_ok_and(|other| *other < ms);
            is_faster && !self.is_exact(method)
        });
        if let Some(faster) = faster {
            let wrong = faster.wrong_px / self.verified.max(1) as u64;
            advice.push_str(&format!(
                "\nfaster, if some {wrong} wrong pixels a frame do not matter: {}",
                faster.method
            ));
        }
        advice
    }

    fn reasons(&self, pick: &Measured) -> Vec<String> {
        let Some(drawn) = pick.drawn else {
            return Vec::new();
        };
        let objects = drawn.z_pass + drawn.z_fail;
        let share = |part: u32| f64::from(part) / f64::from(objects.max(1));
        let mut reasons = Vec::new();
        let percent = |part: u32| format!("{:.0} %", 100.0 * share(part));
        if share(drawn.z_pass) > 0.5 {
            let share = percent(drawn.z_pass);
            reasons.push(format!("{share} of the volumes in view need no caps"));
        }
        if share(drawn.light_facing) > 0.1 {
            reasons.push(format!(
                "{} are of closed objects, and need half the side quads",
                percent(drawn.light_facing)
            ));
        }
        if share(drawn.each_side) > 0.1 {
            reasons.push(format!(
                "{} are of objects with few open edges, and need few side quads twice",
                percent(drawn.each_side)
            ));
        }
        if share(drawn.all) > 0.5 {
            reasons.push(format!(
                "but {} are of objects too open to leave triangles out",
                percent(drawn.all)
            ));
        }
        let left_out = self.shape.left_out.unwrap_or(0) as f64 / self.shape.triangles.max(1) as f64;
        if left_out > 0.1 {
            reasons.push(format!(
                "{:.0} % of the triangles are behind others, seen from the light, and need not cast",
                100.0 * left_out
            ));
        }
        let Overdraw { scene, object, .. } = self.shape.overdraw;
        if object > 0.0 && scene / object > WORTH_A_WORD {
            reasons.push(format!(
                "side quads that are cut object by object cover {:.0} % less",
                100.0 * (1.0 - object / scene)
            ));
        }
        if drawn.culled > 0 && f64::from(drawn.culled) > 0.1 * f64::from(objects) {
            reasons.push(format!(
                "{:.0} objects a frame cannot shadow anything in view",
                f64::from(drawn.culled) / self.frames as f64
            ));
        }
        reasons
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::EdgeCounts;

    fn measured(method: &str, shadow_ms: f64, artifact_px: u64) -> Measured {
        Measured {
            method: method.to_owned(),
            shadow_ms: Ok(shadow_ms),
            wrong_px: artifact_px + 1,
            artifact_px,
            drawn: method.contains("plan=auto").then_some(DrawnVolumes {
                z_pass: 16,
                light_facing: 16,
                ..DrawnVolumes::default()
            }),
        }
    }

    fn advice(measured: Vec<Measured>) -> Advice {
        Advice {
            scene: "Spheres".to_owned(),
            shape: Shape {
                triangles: 100,
                objects: 2,
                closed_objects: 2,
                left_out: Some(7),
                closed_triangles: 100,
                edges: EdgeCounts {
                    boundary: 0,
                    manifold: 150,
                    non_manifold: 0,
                },
                open_edges: 0,
                overdraw: Overdraw {
                    infinity: 9.0,
                    scene: 4.0,
                    object: 2.0,
                },
            },
            frames: 8,
            verified: 2,
            size_px: (320, 240),
            measured,
            device: "a device".to_owned(),
        }
    }

    #[test]
    fn the_fastest_exact_method_is_advised_and_a_faster_wrong_one_is_named() {
        let advice = advice(vec![
            measured(FULL, 40.0, 0),
            measured("silhouette_ts,plan=auto", 9.0, 30),
            measured("silhouette_gs,plan=auto", 10.0, 2),
            measured("cube_shadow_map", 20.0, 900),
        ]);
        let text = advice.to_string();
        assert!(
            text.contains("advice: silhouette_gs,plan=auto, 4.0 times as fast as silhouette_gs"),
            "{text}"
        );
        assert!(
            text.contains("100 % of the volumes in view need no caps"),
            "{text}"
        );
        assert!(text.contains("cover 50 % less"), "{text}");
        let wrong =
            "faster, if some 15 wrong pixels a frame do not matter: silhouette_ts,plan=auto";
        assert!(text.contains(wrong), "{text}");
    }

    #[test]
    fn where_all_are_wrong_none_is_advised_but_what_is_as_right_as_the_full_volumes() {
        let wrong = advice(vec![measured("cube_shadow_map", 20.0, 900)]);
        assert!(wrong.to_string().contains("advice: none"), "{wrong}");
        let alike = advice(vec![measured(FULL, 40.0, 7), measured("other", 20.0, 7)]);
        assert_eq!(
            alike.pick().map(|(method, _)| &*method.method),
            Some("other")
        );
    }
}
