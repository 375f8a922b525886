// How often a face counts: twin of `Weights` in src/methods/corner.rs.

// The most that a face may.
override most_weight: u32;
override vertex_bits: u32;

// Faces that count so often together.
fn faces_of(multiplicity: i32) -> u32 {
    return (u32(abs(multiplicity)) + most_weight - 1u) / most_weight;
}

// The bits in a corner's number that say how often its face counts: it, or the last of them, does what the others leave.
fn weight_bits(multiplicity: i32, face: u32) -> u32 {
    let left = u32(abs(multiplicity)) - face * most_weight;
    return (min(left, most_weight) - 1u) << vertex_bits;
}
