//! How much of the light reaches a point, and how well that is known.

/// How much of the light reaches the visible side of a surface, from 0 to 1, as what it is at least and at most, in
/// the steps of a mask's byte.
///
/// Of a light without size a point sees all or nothing, or it cannot be told: then it is anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Visibility {
    low: u8,
    high: u8,
}

impl Visibility {
    /// All of the light.
    pub const FULL: Self = Self {
        low: u8::MAX,
        high: u8::MAX,
    };
    /// Nothing of the light.
    pub const NONE: Self = Self { low: 0, high: 0 };
    /// Anything between.
    pub const UNKNOWN: Self = Self {
        low: 0,
        high: u8::MAX,
    };

    /// From what it is at least and at most, in 255ths; `None` if that is the wrong way round.
    #[must_use]
    pub fn between(low: u8, high: u8) -> Option<Self> {
        (low <= high).then_some(Self { low, high })
    }

    /// What it is at least and at most, in 255ths.
    #[must_use]
    pub fn bounds(self) -> (u8, u8) {
        (self.low, self.high)
    }

    /// The middle of what it may be, from 0 to 1.
    #[must_use]
    pub fn value(self) -> f64 {
        (f64::from(self.low) + f64::from(self.high)) / 2.0 / f64::from(u8::MAX)
    }

    /// How far it may be from [`Self::value`].
    #[must_use]
    pub fn doubt(self) -> f64 {
        f64::from(self.high - self.low) / 2.0 / f64::from(u8::MAX)
    }

    /// What holds for either of two.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn value_and_doubt_of_what_is_known() {
        let known = |v: Visibility| (v.value(), v.doubt());
        assert_eq!(known(Visibility::FULL), (1.0, 0.0));
        assert_eq!(known(Visibility::NONE), (0.0, 0.0));
        assert_eq!(known(Visibility::UNKNOWN), (0.5, 0.5));
        assert_eq!(Visibility::between(51, 102).map(known), Some((0.3, 0.1)));
        assert_eq!(Visibility::between(2, 1), None);
        let either = Visibility::FULL.or(Visibility::NONE);
        assert_eq!(either, Visibility::UNKNOWN);
        assert_eq!(either.or(Visibility::FULL), Visibility::UNKNOWN);
    }
}
