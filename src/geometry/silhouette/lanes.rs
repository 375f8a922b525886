//! Planes eight at a time against one light: loops over lanes that a compiler turns into vector instructions.
//!
//! What these say is certain or left open, never wrong: see [`ROUNDING`].

use glam::{DVec4, Vec2, Vec4};

/// How many there are at a time.
pub(super) const LANES: usize = 8;

/// One number of each.
pub(super) type Lanes = [f32; LANES];

/// In units of 2⁻²⁴: a facing is found in 32 bits by up to eight roundings; a distance from a plane takes seven, those of
/// plane and light to 32 bits among them. The rest is for the planes, found in 64 bits, and for the sum of the doubt.
const ROUNDING: f32 = 20.0 / (1u32 << 24) as f32;

/// A light as a hyperplane.
pub(super) struct DualLight {
    light: [f32; 4],
    /// What rounding grows with: [`ROUNDING`] times the sum of the first three components without signs, and times the
    /// last.
    size: [f32; 2],
}

impl DualLight {
    pub(super) fn new(light: DVec4) -> Self {
        let light = light.as_vec4();
        let place = light.truncate().abs().element_sum();
        Self {
            light: light.to_array(),
            size: [ROUNDING * place, ROUNDING * light.w.abs()],
        }
    }
}

/// Points in dual space: planes, or corners of boxes around planes.
#[derive(Clone, Copy, Default)]
pub(super) struct Points([Lanes; 4]);

impl Points {
    pub(super) fn set(&mut self, lane: usize, point: Vec4) {
        for (axis, value) in self.0.iter_mut().zip(point.to_array()) {
            axis[lane] = value;
        }
    }

    /// Distances of the light from these planes.
    pub(super) fn distances(&self, light: &DualLight) -> Lanes {
        let [x, y, z, w] = &self.0;
        distances([x, y, z, w], light)
    }
}

fn distances([x, y, z, w]: [&Lanes; 4], light: &DualLight) -> Lanes {
    let of = light.light;
    std::array::from_fn(|i| (x[i] * of[0] + y[i] * of[1]) + (z[i] * of[2] + w[i] * of[3]))
}

/// How far rounding may reach in a distance.
#[derive(Clone, Copy, Default)]
pub(super) struct Doubts([Lanes; 2]);

impl Doubts {
    /// Nothing is certain.
    pub(super) const ALL: Self = Self([[f32::INFINITY; LANES]; 2]);

    pub(super) fn set(&mut self, lane: usize, doubt: Vec2) {
        self.0[0][lane] = doubt.x;
        self.0[1][lane] = doubt.y;
    }

    /// A doubt beyond all numbers may become none at all (0 · ∞). So what is not certainly beyond it is in doubt.
    pub(super) fn under(&self, light: &DualLight) -> Lanes {
        let [place, w] = &self.0;
        std::array::from_fn(|i| place[i] * light.size[0] + w[i] * light.size[1])
    }
}

/// A box around planes, in 32 bits.
#[derive(Clone, Copy)]
pub(super) struct OneBox {
    pub(super) low: Vec4,
    pub(super) high: Vec4,
    /// See [`Doubts`].
    pub(super) doubt: Vec2,
}

impl OneBox {
    /// Around no plane.
    pub(super) const EMPTY: Self = Self {
        low: Vec4::INFINITY,
        high: Vec4::NEG_INFINITY,
        doubt: Vec2::ZERO,
    };

    pub(super) fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            doubt: self.doubt.max(other.doubt),
        }
    }
}

/// Boxes around planes.
#[derive(Clone, Copy, Default)]
pub(super) struct Boxes {
    low: Points,
    high: Points,
    doubt: Doubts,
}

impl Boxes {
    pub(super) fn new(boxes: &[OneBox]) -> Self {
        let mut lanes = Self::default();
        for (lane, one) in boxes.iter().enumerate() {
            lanes.low.set(lane, one.low);
            lanes.high.set(lane, one.high);
            lanes.doubt.set(lane, one.doubt);
        }
        lanes
    }

    /// Which of them may have planes on both sides of the light's hyperplane, a bit each. Two corners of a box decide,
    /// picked by the signs of the light's components (Wallner 2006, section 2.1).
    pub(super) fn meeting(&self, light: &DualLight) -> u32 {
        let corners = |least: bool| {
            std::array::from_fn(|axis| {
                let is_low = (light.light[axis] >= 0.0) == least;
                let corner = if is_low { &self.low } else { &self.high };
                &corner.0[axis]
            })
        };
        let least = distances(corners(true), light);
        let most = distances(corners(false), light);
        let doubt = self.doubt.under(light);
        !mask(|i| (least[i] > doubt[i]) | (most[i] < -doubt[i]))
    }
}

/// A bit for each lane.
pub(super) fn mask(holds: impl Fn(usize) -> bool) -> u32 {
    (0..LANES).fold(0, |mask, i| mask | u32::from(holds(i)) << i)
}

/// The lanes of a mask, one after the other.
pub(super) fn lanes_of(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = mask.trailing_zeros() as usize;
        mask &= mask.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    })
}
