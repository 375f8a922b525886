//! Smooth curves through keys in time.
//!
//! A Catmull-Rom spline whose knots are the times of the keys: it passes through each key at its time, and its
//! velocity has no jumps. Two keys make a straight line, one stands still.

use glam::Vec3;

/// What holds at one time of a path.
pub(super) trait Key {
    /// When, from the start of the path.
    fn time_s(&self) -> f64;
}

/// How long the path takes.
pub(super) fn duration_s<K: Key>(keys: &[K]) -> f64 {
    keys.last().map_or(0.0, Key::time_s)
}

/// The first key whose time is not after that of the one before, or for the first one, not 0.
pub(super) fn out_of_order<K: Key>(keys: &[K]) -> Option<usize> {
    let is_wrong = |i: usize| {
        let time_s = keys[i].time_s();
        let follows = match i.checked_sub(1) {
            None => time_s == 0.0,
            Some(before) => time_s > keys[before].time_s(),
        };
        !follows || !time_s.is_finite()
    };
    (0..keys.len()).find(|i| is_wrong(*i))
}

/// What the curve is at a time; before the start it is the first key, and after the end the last.
///
/// # Panics
/// If there are no keys.
pub(super) fn sample<K: Key>(keys: &[K], time_s: f64, of: impl Fn(&K) -> Vec3) -> Vec3 {
    let time_s = time_s.clamp(0.0, duration_s(keys));
    let after = keys.partition_point(|key| key.time_s() <= time_s);
    let i = after.saturating_sub(1);
    match keys.get(i + 1) {
        None => of(&keys[i]),
        Some(next) => {
            let start_s = keys[i].time_s();
            interpolate(keys, i, (time_s - start_s) / (next.time_s() - start_s), of)
        }
    }
}

/// The cubic between keys `i` and `i + 1` at `s` from 0 to 1, by Hermite's basis.
fn interpolate<K: Key>(keys: &[K], i: usize, s: f64, of: impl Fn(&K) -> Vec3) -> Vec3 {
    let duration_s = keys[i + 1].time_s() - keys[i].time_s();
    let [m0, m1] = [i, i + 1].map(|k| velocity(keys, k, &of) * duration_s as f32);
    let [p0, p1] = [i, i + 1].map(|k| of(&keys[k]));
    let (s1, s2, s3) = (s as f32, (s * s) as f32, (s * s * s) as f32);
    let blend = 3.0 * s2 - 2.0 * s3;
    p0 + (p1 - p0) * blend + m0 * (s3 - 2.0 * s2 + s1) + m1 * (s3 - s2)
}

/// Units a second at key `i`: the slope there of the parabola through the key and its two neighbours; at an
/// end, of the line to the only neighbour.
fn velocity<K: Key>(keys: &[K], i: usize, of: impl Fn(&K) -> Vec3) -> Vec3 {
    let slope = |from: usize, to: usize| {
        let (from, to) = (&keys[from], &keys[to]);
        let duration_s = to.time_s() - from.time_s();
        ((of(to) - of(from)) / duration_s as f32, duration_s)
    };
    if i == 0 {
        return slope(0, 1).0;
    }
    let (before, before_s) = slope(i - 1, i);
    if i + 1 == keys.len() {
        return before;
    }
    let (after, after_s) = slope(i, i + 1);
    // The shorter side weighs more.
    before.lerp(after, (before_s / (before_s + after_s)) as f32)
}
