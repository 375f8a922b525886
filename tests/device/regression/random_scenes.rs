//! Random scenes in which a method once failed, or in which the truth did not know what is undefined.

use crate::common::device;
use crate::stability::{SIZE_PX, assert_sound};
use svbench::judge::Judge;

/// What [`svbench::stress::random`] makes them of.
const SEEDS_THAT_FAILED: [u64; 41] = [
    33, 35, 64, 89, 133, 300, 341, 518, 551, 683, 685, 844, 967, 1420, 1512, 1656, 1729, 1795,
    1803, 2386, 2454, 2809, 3111, 3175, 3578, 4651, 4774, 4875, 5203, 5216, 5435, 6418, 6759, 7285,
    8128, 8226, 8582, 8692, 9028, 9780, 9807,
];

#[test]
fn random_scenes_that_failed_fail_no_more() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    assert_sound(&judge, SEEDS_THAT_FAILED.into_iter());
}
