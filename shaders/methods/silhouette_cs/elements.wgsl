// The faces of shadow volumes as corners, counter-clockwise seen from outside of the volume: twin of
// src/methods/silhouette_cpu/faces.rs.

// Where the corners of a block's faces begin in each list.
@group(1) @binding(8) var<storage, read> corners: array<vec4<u32>>;
@group(1) @binding(9) var<storage, read_write> elements: array<u32>;

// The buffer may hold fewer corners than there are: then all are made in rounds, so many in each.
override corners_a_round: u32;
override this_round: u32;

fn emit(place: u32, a: u32, b: u32, c: u32) {
    // Wraps around to more than there are where the place is one of a round before.
    let at = place - this_round * corners_a_round;
    if at < corners_a_round {
        elements[at] = a;
        elements[at + 1u] = b;
        elements[at + 2u] = c;
    }
}
