//! Sets of numbers that grow together.

/// Numbers in disjoint sets, each known by the smallest of its numbers.
pub struct DisjointSets {
    parents: Vec<u32>,
}

impl DisjointSets {
    /// Each of the first `count` numbers in a set of its own.
    pub fn new(count: u32) -> Self {
        Self {
            parents: (0..count).collect(),
        }
    }

    /// The smallest number of the set that one is in.
    pub fn smallest(&mut self, mut of: u32) -> u32 {
        while self.parents[of as usize] != of {
            // Paths are halved on the way.
            self.parents[of as usize] = self.parents[self.parents[of as usize] as usize];
            of = self.parents[of as usize];
        }
        of
    }

    /// Makes one set of those that two numbers are in.
    pub fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.smallest(one), self.smallest(other));
        self.parents[one.max(other) as usize] = one.min(other);
    }
}
