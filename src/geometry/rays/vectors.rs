//! Sixteen vectors at once, one for each ray of a packet.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};
use glam::Vec3;

/// Rays of a packet.
pub(super) const LANES: usize = 16;

/// Boxes that touch a slab's border must not meet 0 × ∞: a finite stand-in for 1 / 0, whose product with any coordinate
/// is finite, too.
pub(super) const LARGEST_INVERSE: f32 = 1e28;

/// A vector for each ray.
#[derive(Clone, Copy)]
pub(super) struct Vectors<S: Simd> {
    pub(super) x: f32x16<S>,
    pub(super) y: f32x16<S>,
    pub(super) z: f32x16<S>,
}

impl<S: Simd> Vectors<S> {
    /// Given by components.
    #[inline(always)]
    pub(super) fn new(simd: S, [x, y, z]: [&[f32; LANES]; 3]) -> Self {
        Self {
            x: f32x16::from_slice(simd, x),
            y: f32x16::from_slice(simd, y),
            z: f32x16::from_slice(simd, z),
        }
    }

    /// The same for all.
    #[inline(always)]
    pub(super) fn splat(simd: S, v: Vec3) -> Self {
        Self {
            x: f32x16::splat(simd, v.x),
            y: f32x16::splat(simd, v.y),
            z: f32x16::splat(simd, v.z),
        }
    }

    /// One of them.
    #[inline(always)]
    pub(super) fn lane(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    #[inline(always)]
    pub(super) fn add(self, other: Self) -> Self {
        Self {
            x: self.x + other.x,
            y: self.y + other.y,
            z: self.z + other.z,
        }
    }

    #[inline(always)]
    pub(super) fn minus(self, other: Self) -> Self {
        Self {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }

    #[inline(always)]
    pub(super) fn times(self, other: Self) -> Self {
        Self {
            x: self.x * other.x,
            y: self.y * other.y,
            z: self.z * other.z,
        }
    }

    /// Each times a number of its own.
    #[inline(always)]
    pub(super) fn times_each(self, factor: f32x16<S>) -> Self {
        Self {
            x: factor * self.x,
            y: factor * self.y,
            z: factor * self.z,
        }
    }

    /// This and a multiple of another.
    #[inline(always)]
    pub(super) fn plus(self, factor: f32x16<S>, other: Self) -> Self {
        Self {
            x: self.x + factor * other.x,
            y: self.y + factor * other.y,
            z: self.z + factor * other.z,
        }
    }

    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> f32x16<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The dot product with one vector for all.
    #[inline(always)]
    pub(super) fn along(self, simd: S, v: Vec3) -> f32x16<S> {
        self.dot(Self::splat(simd, v))
    }

    #[inline(always)]
    pub(super) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// One by each component, or a finite number for that.
    #[inline(always)]
    pub(super) fn inverse(self, simd: S) -> Self {
        let largest = f32x16::splat(simd, LARGEST_INVERSE);
        Self {
            x: (1.0 / self.x).min(largest).max(-largest),
            y: (1.0 / self.y).min(largest).max(-largest),
            z: (1.0 / self.z).min(largest).max(-largest),
        }
    }

    /// The smallest and the largest of each component.
    #[inline(always)]
    pub(super) fn range(self) -> (Vec3, Vec3) {
        (
            Vec3::new(least(self.x), least(self.y), least(self.z)),
            -Vec3::new(least(-self.x), least(-self.y), least(-self.z)),
        )
    }
}

#[inline(always)]
fn least<S: Simd>(of: f32x16<S>) -> f32 {
    let (low, high) = of.split();
    let (low, high) = low.min(high).split();
    let [a, b, c, d] = low.min(high).to_array();
    a.min(b).min(c.min(d))
}
