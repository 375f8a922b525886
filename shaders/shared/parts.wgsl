// Parts of work that one kernel leaves to the next: see src/methods/parts.rs.

// How many were left, whether or not there was room; nothing; then of each a triangle or more, and a place, as the kernels
// number them.
@group(2) @binding(0) var<storage, read_write> parts: array<atomic<u32>>;

struct Part {
    item: u32,
    place: u32,
}

// False if there is no room.
fn leave_part(part: Part) -> bool {
    let at = 2u + 2u * atomicAdd(&parts[0], 1u);
    if at + 1u >= arrayLength(&parts) {
        return false;
    }
    atomicStore(&parts[at], part.item);
    atomicStore(&parts[at + 1u], part.place);
    return true;
}

fn part_count() -> u32 {
    return min(atomicLoad(&parts[0]), (arrayLength(&parts) - 2u) / 2u);
}

fn part_at(number: u32) -> Part {
    return Part(atomicLoad(&parts[2u + 2u * number]), atomicLoad(&parts[3u + 2u * number]));
}
