// Parts of work that one kernel leaves to the next: see src/methods/parts.rs.

// How many were left, whether or not there was room; three words that nobody uses; then two words a part: a triangle or more,
// and a place, as the kernels number them.
@group(2) @binding(0) var<storage, read_write> parts: array<atomic<u32>>;

const HEADER: u32 = 4u;

struct Part {
    item: u32,
    place: u32,
}

fn room() -> u32 {
    return (arrayLength(&parts) - HEADER) / 2u;
}

// False if there is no room.
fn leave_part(part: Part) -> bool {
    let number = atomicAdd(&parts[0], 1u);
    if number >= room() {
        return false;
    }
    let word = HEADER + 2u * number;
    atomicStore(&parts[word], part.item);
    atomicStore(&parts[word + 1u], part.place);
    return true;
}

fn part_count() -> u32 {
    return min(atomicLoad(&parts[0]), room());
}

fn part_at(number: u32) -> Part {
    let word = HEADER + 2u * number;
    return Part(atomicLoad(&parts[word]), atomicLoad(&parts[word + 1u]));
}

// The part of a workgroup; there may be none.
fn number_of(workgroup: vec3<u32>, workgroups: vec3<u32>) -> u32 {
    return workgroup.y * workgroups.x + workgroup.x;
}
