//! What keeps a device from being opened.

/// Why no device could be opened.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// The system has no driver that wgpu can use.
    #[error(
        "no graphics device found: install a Vulkan driver (scripts/run.sh installs Mesa's software driver where it may)"
    )]
    NoAdapter,
    /// `--adapter` names none of the adapters.
    #[error("no adapter's name contains `{wanted}`; there are: {}", .found.join(", "))]
    NoSuchAdapter {
        /// The name asked for.
        wanted: String,
        /// The names that exist.
        found: Vec<String>,
    },
    /// The adapter lacks something that every run needs.
    #[error("`{adapter}` cannot run svbench: it lacks {missing}")]
    Unsuitable {
        /// The adapter's name.
        adapter: String,
        /// What is missing.
        missing: String,
    },
    /// Validation is asked for where nothing validates.
    #[error(
        "--validation: `{adapter}` runs on {backend}, and the validation layers are of Vulkan alone: name another \
         device with --adapter, or leave --validation out"
    )]
    ValidationNeedsVulkan {
        /// The adapter's name.
        adapter: String,
        /// What it runs on.
        backend: String,
    },
    /// Validation is asked for and its layers are not there.
    #[error(
        "--validation: the Vulkan loader finds no layer VK_LAYER_KHRONOS_validation: install the validation layers \
         (Debian and Ubuntu: vulkan-validationlayers; Fedora: vulkan-validation-layers; else the Vulkan SDK), or \
         name their folder in VK_ADD_LAYER_PATH"
    )]
    NoValidationLayer,
    /// The driver refused to open the device.
    #[error("`{adapter}` could not be opened: {reason}")]
    Open {
        /// The adapter's name.
        adapter: String,
        /// The driver's words.
        reason: String,
    },
}
