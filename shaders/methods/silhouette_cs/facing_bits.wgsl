// The facing of a triangle in the words of find_facings.wgsl.
fn facing_in(words: vec2<u32>, triangle: u32) -> i32 {
    let bits = (words >> vec2<u32>(triangle % 32u)) & vec2<u32>(1u);
    return i32(bits.x) - i32(bits.y);
}
