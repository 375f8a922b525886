//! What a frame took on its two clocks, device and processor.
//!
//! A stage has time on the device (between timestamps) and time on the processor (what the method works there;
//! recording commands is not in it). A frame is a chain of both: work on the processor comes before the submission
//! that it feeds, and the device goes on while the processor works on what it submits next. The timeline lays the
//! measured times out in that order and takes the length of the longest path through them, so that work that
//! overlaps is counted once, and a gap in which neither works is not counted at all.

/// What a stage took on each clock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StageTime {
    /// The stage.
    pub name: &'static str,
    /// Time on the device, in milliseconds.
    pub device_ms: f64,
    /// Time on the processor, in milliseconds.
    pub processor_ms: f64,
}

/// What happened in a frame, in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Event {
    /// The processor worked, in the stage with this index.
    Processor { stage: usize, ms: f64 },
    /// The device was given work of the stage with this index, between two timestamps.
    Device { stage: usize, from: u32, to: u32 },
    /// What was recorded so far was submitted before the frame was complete.
    Submit,
    /// The processor waited until the device had done what was submitted.
    Wait,
}

/// The two clocks while a frame is laid out, in milliseconds from its start.
#[derive(Debug, Clone, Copy, Default)]
struct Clocks {
    processor_ms: f64,
    device_ms: f64,
    /// Device work that is recorded and not submitted yet.
    recorded_ms: f64,
}

impl Clocks {
    fn submit(&mut self) {
        self.device_ms = self.device_ms.max(self.processor_ms) + self.recorded_ms;
        self.recorded_ms = 0.0;
    }

    /// The end of all that was done or recorded so far.
    fn end_ms(&self) -> f64 {
        let mut end = *self;
        end.submit();
        end.processor_ms.max(end.device_ms)
    }
}

/// A frame laid out.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Timeline {
    pub(super) stages: Vec<StageTime>,
    /// What each stage adds to the longest path through all of it; the sum is that path.
    pub(super) added_ms: Vec<f64>,
}

impl Timeline {
    /// Of the stages in `names` by their `events`; `device_ms` gives the time between two timestamps.
    pub(super) fn new(
        names: &[&'static str],
        events: &[Event],
        device_ms: impl Fn(u32, u32) -> f64,
    ) -> Self {
        let zero = |&name: &&'static str| StageTime {
            name,
            device_ms: 0.0,
            processor_ms: 0.0,
        };
        let mut stages: Vec<_> = names.iter().map(zero).collect();
        let mut added_ms = vec![0.0; names.len()];
        let mut clocks = Clocks::default();
        for event in events {
            let before_ms = clocks.end_ms();
            match *event {
                Event::Processor { stage, ms } => {
                    stages[stage].processor_ms += ms;
                    clocks.processor_ms += ms;
                    added_ms[stage] += clocks.end_ms() - before_ms;
                }
                Event::Device { stage, from, to } => {
                    let ms = device_ms(from, to);
                    stages[stage].device_ms += ms;
                    clocks.recorded_ms += ms;
                    added_ms[stage] += clocks.end_ms() - before_ms;
                }
                Event::Submit => clocks.submit(),
                Event::Wait => clocks.processor_ms = clocks.processor_ms.max(clocks.device_ms),
            }
        }
        Self { stages, added_ms }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Timestamps are milliseconds here.
    fn timeline(names: &[&'static str], events: &[Event]) -> Timeline {
        Timeline::new(names, events, |from, to| f64::from(to - from))
    }

    fn frame_ms(frame: &Timeline) -> f64 {
        frame.added_ms.iter().sum()
    }

    fn device(stage: usize, from: u32, to: u32) -> Event {
        Event::Device { stage, from, to }
    }

    fn processor(stage: usize, ms: f64) -> Event {
        Event::Processor { stage, ms }
    }

    #[test]
    fn a_frame_of_the_device_alone_is_the_sum_of_its_stages() {
        let frame = timeline(&["a", "b"], &[device(0, 0, 4), device(1, 4, 7)]);
        assert_eq!(frame_ms(&frame), 7.0);
        assert_eq!(frame.added_ms, [4.0, 3.0]);
    }

    #[test]
    fn the_processor_comes_before_the_submission_that_it_feeds() {
        let events = [device(0, 0, 4), processor(1, 5.0), device(2, 4, 6)];
        let frame = timeline(&["gbuffer", "find", "draw"], &events);
        assert_eq!(frame_ms(&frame), 11.0);
        assert_eq!(frame.stages[1].processor_ms, 5.0);
        assert_eq!(frame.added_ms, [4.0, 5.0, 2.0]);
    }

    #[test]
    fn work_beside_the_device_is_counted_once() {
        // The device has 10 ms of work while the processor works for 4, and then for 9.
        let beside = |ms| {
            let events = [
                device(0, 0, 10),
                Event::Submit,
                processor(1, ms),
                device(2, 10, 12),
            ];
            timeline(&["gbuffer", "find", "draw"], &events)
        };
        assert_eq!(frame_ms(&beside(4.0)), 12.0);
        assert_eq!(beside(4.0).added_ms, [10.0, 0.0, 2.0]);
        assert_eq!(frame_ms(&beside(11.0)), 13.0);
        assert_eq!(beside(11.0).added_ms, [10.0, 1.0, 2.0]);
    }

    #[test]
    fn what_waits_for_the_device_does_not_overlap_it() {
        let events = [
            device(0, 0, 10),
            Event::Submit,
            Event::Wait,
            processor(1, 4.0),
            device(2, 10, 12),
        ];
        let frame = timeline(&["ids", "find", "draw"], &events);
        assert_eq!(frame_ms(&frame), 16.0);
        assert_eq!(frame.added_ms, [10.0, 4.0, 2.0]);
    }

    proptest! {
        /// Never longer than one after the other, never shorter than the longer clock, and the stages' shares
        /// make up the whole.
        #[test]
        fn the_longest_path_lies_between_the_longer_clock_and_the_sum(
            steps in prop::collection::vec((0_u8..4, 0_u32..20), 0..30),
        ) {
            let names = vec!["stage"; steps.len()];
            let mut at = 0;
            let events: Vec<_> = steps.iter().enumerate().map(|(stage, &(kind, ms))| match kind {
                0 => processor(stage, f64::from(ms)),
                1 => { at += ms; device(stage, at - ms, at) }
                2 => Event::Submit,
                _ => Event::Wait,
            }).collect();
            let frame = timeline(&names, &events);
            let sum = |time: fn(&StageTime) -> f64| frame.stages.iter().map(time).sum::<f64>();
            let (device_ms, processor_ms) = (sum(|s| s.device_ms), sum(|s| s.processor_ms));
            prop_assert!(frame_ms(&frame) >= device_ms.max(processor_ms));
            prop_assert!(frame_ms(&frame) <= device_ms + processor_ms);
        }
    }
}
