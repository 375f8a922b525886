//! Planes eight at a time against one light.
//!
//! What these say is certain or left open, never wrong: see [`ROUNDING`].

use bytemuck::{Pod, Zeroable};
use glam::{DVec4, Vec2, Vec4};
use std::ops::{Add, Mul, Neg, Sub};

/// How many there are at a time.
pub(super) const LANES: usize = 8;

/// A number of each, in two vector registers.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(transparent)]
pub(super) struct Lanes([Vec4; 2]);

/// In units of 2⁻²⁴: a facing is found in 32 bits by up to eight roundings; a distance from a plane takes up to eight, those
/// of plane and light to 32 bits among them. The rest is for the planes, found in 64 bits, and for the sum of the doubt.
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

    /// Its components, and those by which rounding grows, see [`Doubts`].
    pub(super) fn components(&self) -> ([f32; 4], [f32; 2]) {
        (self.light, self.size)
    }

    pub(super) fn vector(&self) -> Vec4 {
        Vec4::from_array(self.light)
    }

    /// Its distance from a plane.
    pub(super) fn distance(&self, plane: Vec4) -> f32 {
        self.vector().dot(plane)
    }

    /// How far rounding may reach in a distance, see [`Doubts`].
    pub(super) fn doubt(&self, doubt: Vec2) -> f32 {
        doubt.x * self.size[0] + doubt.y * self.size[1]
    }
}

/// Points in dual space: planes, or corners of boxes around planes.
#[derive(Clone, Copy, Default, Pod, Zeroable)]
#[repr(transparent)]
pub(super) struct Points([Lanes; 4]);

impl Points {
    pub(super) fn set(&mut self, lane: usize, point: Vec4) {
        for (axis, value) in self.0.iter_mut().zip(point.to_array()) {
            axis.set(lane, value);
        }
    }
}

fn distances([x, y, z, w]: [Lanes; 4], light: &DualLight) -> Lanes {
    let of = light.light;
    (x * of[0] + y * of[1]) + (z * of[2] + w * of[3])
}

/// How far rounding may reach in a distance.
#[derive(Clone, Copy, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Doubts {
    place: Lanes,
    w: Lanes,
}

impl Doubts {
    pub(super) fn set(&mut self, lane: usize, doubt: Vec2) {
        self.place.set(lane, doubt.x);
        self.w.set(lane, doubt.y);
    }

    /// A doubt beyond all numbers may become none at all (0 · ∞). So what is not certainly beyond it is in doubt.
    pub(super) fn under(&self, light: &DualLight) -> Lanes {
        self.place * light.size[0] + self.w * light.size[1]
    }
}

/// A box around planes, in 32 bits.
#[derive(Clone, Copy, Default)]
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
#[derive(Clone, Copy, Default, Pod, Zeroable)]
#[repr(C)]
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
                corner.0[axis]
            })
        };
        let least = distances(corners(true), light);
        let most = distances(corners(false), light);
        let doubt = self.doubt.under(light);
        !(least.above(doubt) | (-most).above(doubt))
    }
}

impl Lanes {
    pub(super) fn from_array(lanes: [f32; LANES]) -> Self {
        let [a, b, c, d, e, f, g, h] = lanes;
        Self([Vec4::new(a, b, c, d), Vec4::new(e, f, g, h)])
    }

    #[inline]
    pub(super) fn from_u16(lanes: &[u16; LANES]) -> Self {
        let [a, b, c, d, e, f, g, h] = *lanes;
        let half = |a: u16, b: u16, c: u16, d: u16| {
            Vec4::new(f32::from(a), f32::from(b), f32::from(c), f32::from(d))
        };
        Self([half(a, b, c, d), half(e, f, g, h)])
    }

    pub(super) fn splat(value: f32) -> Self {
        Self([Vec4::splat(value); 2])
    }

    pub(super) fn set(&mut self, lane: usize, value: f32) {
        self.0[lane / 4][lane % 4] = value;
    }

    /// Which are above those of another: a bit each. None is where one of both is no number.
    pub(super) fn above(self, other: Self) -> u32 {
        let [low, high] = [0, 1].map(|half| self.0[half].cmpgt(other.0[half]).bitmask());
        low | high << 4
    }
}

impl Add for Lanes {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self([self.0[0] + other.0[0], self.0[1] + other.0[1]])
    }
}

impl Sub for Lanes {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self([self.0[0] - other.0[0], self.0[1] - other.0[1]])
    }
}

impl Mul for Lanes {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self([self.0[0] * other.0[0], self.0[1] * other.0[1]])
    }
}

impl Mul<f32> for Lanes {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self(self.0.map(|half| half * factor))
    }
}

impl Neg for Lanes {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|half| -half))
    }
}

/// The lanes of a mask, one after the other.
pub(super) fn lanes_of(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = mask.trailing_zeros() as usize;
        mask &= mask.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    })
}
