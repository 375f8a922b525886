//! Rays towards the light, against triangles, in double precision.

use glam::DVec3;

/// A ray this near to an edge, as a part of the distances involved, does not decide on which side of it it is.
const DOUBT: f64 = 1e-9;

/// From a point towards the light.
pub(super) struct Ray {
    pub(super) from: DVec3,
    pub(super) towards: DVec3,
    /// Whether it ends there.
    pub(super) ends: bool,
}

impl Ray {
    /// 0 if the triangle is not on the way to the light, 1 if it is and looks counter-clockwise from the light, -1 if it
    /// looks clockwise; `None` where that is too near to tell.
    pub(super) fn pierces(&self, corners: [DVec3; 3]) -> Option<i32> {
        let [a, b, c] = corners.map(|corner| corner - self.from);
        let length = self.towards.length();
        let mut sides = [0; 3];
        for (side, (p, q)) in sides.iter_mut().zip([(a, b), (b, c), (c, a)]) {
            let distance = self.towards.dot(p.cross(q));
            *side = sign(distance, DOUBT * length * p.length() * q.length());
        }
        if sides.contains(&1) && sides.contains(&-1) {
            return Some(0);
        }
        if sides.contains(&0) {
            return None;
        }
        let normal = (b - a).cross(c - a);
        let (along, ahead) = (normal.dot(self.towards), normal.dot(a));
        // The plane is met at this part of the way.
        let at = ahead / along;
        let doubt = DOUBT * normal.length() * (length + a.length()) / along.abs();
        if at.is_nan() || at.abs() <= doubt || self.ends && (at - 1.0).abs() <= doubt {
            return None;
        }
        let is_before = at > 0.0 && !(self.ends && at > 1.0);
        Some(if is_before { sides[0] } else { 0 })
    }
}

fn sign(x: f64, doubt: f64) -> i32 {
    if x > doubt {
        1
    } else if x < -doubt {
        -1
    } else {
        0
    }
}
