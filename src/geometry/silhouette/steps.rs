//! Planes in 16 bits.

use super::lanes::{DualLight, LANES, Lanes, OneBox};
use bytemuck::{Pod, Zeroable};
use glam::Vec4;

/// So many steps lead from one side of a box to the other.
const STEPS: f32 = u16::MAX as f32;

/// A box around planes, and how they are kept in it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct StepBox {
    low: [f32; 4],
    /// How long a step is along each axis.
    step: [f32; 4],
    /// See [`OneBox::doubt`].
    doubt: [f32; 2],
}

/// Planes in a box around them, by steps from its low corner along each axis.
#[derive(Clone, Copy, Default, Pod, Zeroable)]
#[repr(transparent)]
pub(super) struct StepPoints([[u16; LANES]; 4]);

/// What the steps in a box mean for a light.
pub(super) struct Steps {
    /// The light's distance from the plane at the low corner.
    at_low: f32,
    /// How much that grows with a step along each axis.
    per_step: [f32; 4],
    doubt: f32,
}

/// On which side of the light's hyperplane planes certainly are: a bit each.
#[derive(Clone, Copy, Default)]
pub(super) struct Sides {
    pub(super) before: u32,
    pub(super) behind: u32,
}

impl StepBox {
    pub(super) fn of(planes: OneBox) -> Self {
        Self {
            low: planes.low.to_array(),
            step: ((planes.high - planes.low) / STEPS).to_array(),
            doubt: planes.doubt.to_array(),
        }
    }

    pub(super) fn under(&self, light: &DualLight) -> Steps {
        let per_step = light.vector() * Vec4::from_array(self.step);
        Steps {
            at_low: light.distance(self.low.into()),
            per_step: per_step.to_array(),
            // A plane is up to half a step away from where it is kept. The other half is more than what rounding adds on
            // the way from the low corner, which is 2¹⁶ steps at most: a rounding is of 2⁻²⁴.
            doubt: light.doubt(self.doubt.into()) + per_step.abs().element_sum(),
        }
    }
}

impl StepPoints {
    pub(super) fn set(&mut self, lane: usize, point: Vec4, around: &StepBox) {
        let steps = (point - Vec4::from_array(around.low)) / Vec4::from_array(around.step);
        for (axis, steps) in self.0.iter_mut().zip(steps.round().to_array()) {
            // In a flat box there is nothing but the low corner: 0 / 0 becomes 0.
            axis[lane] = steps as u16;
        }
    }
}

impl Steps {
    #[inline]
    pub(super) fn sides(&self, planes: &StepPoints, known: u32) -> Sides {
        let [x, y, z, w] = &planes.0;
        let of = self.per_step;
        let steps = (Lanes::from_u16(x) * of[0] + Lanes::from_u16(y) * of[1])
            + (Lanes::from_u16(z) * of[2] + Lanes::from_u16(w) * of[3]);
        let distances = Lanes::splat(self.at_low) + steps;
        let doubt = Lanes::splat(self.doubt);
        Sides {
            before: distances.above(doubt) & known,
            behind: (-distances).above(doubt) & known,
        }
    }
}
