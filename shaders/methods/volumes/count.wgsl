// What a face adds to a count where it is seen from outside of the volume; from inside it takes it away.
override seen_from_outside: f32 = 1.0;

@fragment
fn count(
    @builtin(front_facing) is_outside: bool,
    @location(0) @interpolate(flat) weight: f32,
) -> @location(0) f32 {
    return weight * select(-seen_from_outside, seen_from_outside, is_outside);
}
