//! What all tests on a device share.
#![allow(dead_code, reason = "each test program uses its own part")]

use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use svbench::gpu::{Gpu, GpuOptions, messages};

static DEVICE: LazyLock<Mutex<Gpu>> = LazyLock::new(|| {
    let adapter = std::env::var("SVBENCH_TEST_ADAPTER").ok();
    let options = GpuOptions {
        adapter,
        validation: true,
    };
    Mutex::new(
        Gpu::open(&options).expect("tests need a Vulkan device; scripts/test.sh installs one"),
    )
});

/// The device, for one test at a time; dropping it fails the test if the validation layers spoke.
pub struct Device(MutexGuard<'static, Gpu>);

/// Waits for the device.
pub fn device() -> Device {
    let guard = DEVICE.lock().unwrap_or_else(PoisonError::into_inner);
    messages::take_validation_messages();
    Device(guard)
}

impl std::ops::Deref for Device {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.0
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        self.0.wait_idle();
        let messages = messages::take_validation_messages();
        if !std::thread::panicking() {
            assert!(messages.is_empty(), "validation layers: {messages:#?}");
        }
    }
}
