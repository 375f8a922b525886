//! What not every device can do: one table, from which devices are asked, opened and described.
//!
//! A new capability is an entry at the end of the table in this file. Whatever the device has of it is switched on
//! when the device is opened; a method names in its `needs` what it cannot do without.

use ash::vk;
use serde::{Serialize, Serializer};
use std::ffi::CStr;

/// How a device is asked for a capability, and how that is switched on.
#[derive(Clone, Copy)]
pub(super) enum Source {
    /// A feature of wgpu.
    Wgpu(wgpu::Features),
    /// A feature of Vulkan's core set, which wgpu keeps to itself.
    VulkanFeature(fn(&mut vk::PhysicalDeviceFeatures) -> &mut vk::Bool32),
    /// An extension of Vulkan that is not asked of wgpu, and the features in it, if it has any.
    VulkanExtension(&'static CStr, Option<fn() -> Box<dyn ExtensionFeature>>),
    /// The same on devices of Vulkan 1.2 and later.
    VulkanExtension12(&'static CStr, fn() -> Box<dyn ExtensionFeature>),
    /// What optimally tiled images of a format can be used for in Vulkan; nothing to switch on.
    VulkanFormat(vk::Format, vk::FormatFeatureFlags),
}

/// Features in a structure that an extension of Vulkan brings.
pub(super) trait ExtensionFeature {
    /// Whether the features are there, or are to be switched on.
    fn bits(&mut self) -> Vec<&mut vk::Bool32>;
    /// The structure, to be filled in by the driver.
    fn for_query(&mut self) -> &mut dyn vk::ExtendsPhysicalDeviceFeatures2;
    /// The structure, to open a device with.
    fn for_device(&mut self) -> &mut dyn vk::ExtendsDeviceCreateInfo;
}

struct InStructure<T> {
    structure: T,
    bits: fn(&mut T) -> Vec<&mut vk::Bool32>,
}

impl<T> ExtensionFeature for InStructure<T>
where
    T: vk::ExtendsPhysicalDeviceFeatures2 + vk::ExtendsDeviceCreateInfo,
{
    fn bits(&mut self) -> Vec<&mut vk::Bool32> {
        (self.bits)(&mut self.structure)
    }

    fn for_query(&mut self) -> &mut dyn vk::ExtendsPhysicalDeviceFeatures2 {
        &mut self.structure
    }

    fn for_device(&mut self) -> &mut dyn vk::ExtendsDeviceCreateInfo {
        &mut self.structure
    }
}

/// Features of an extension, in its structure `T`.
fn features<T>(bits: fn(&mut T) -> Vec<&mut vk::Bool32>) -> Box<dyn ExtensionFeature>
where
    T: vk::ExtendsPhysicalDeviceFeatures2 + vk::ExtendsDeviceCreateInfo + Default + 'static,
{
    let structure = T::default();
    Box::new(InStructure { structure, bits })
}

/// Makes the enum of a table: of each capability documentation, name, id, words, and [`Source`].
macro_rules! capabilities {
    ($($(#[$doc:meta])* $name:ident: $id:literal, $words:literal, $source:expr;)*) => {
        /// Something that not every device can do.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Capability {
            $($(#[$doc])* $name,)*
        }

        impl Capability {
            /// Every one, in the order in which they are listed.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// What machines call it.
            pub fn id(self) -> &'static str {
                match self { $(Self::$name => $id,)* }
            }

            /// What it is, as a phrase for people.
            pub fn words(self) -> &'static str {
                match self { $(Self::$name => $words,)* }
            }

            pub(super) fn source(self) -> Source {
                use Source::*;
                match self { $(Self::$name => $source,)* }
            }
        }
    };
}

capabilities! {
    /// Tessellation control and evaluation shaders.
    TessellationStage: "tessellation_stage", "tessellation shaders (Vulkan)",
        VulkanFeature(|core| &mut core.tessellation_shader);
    /// Geometry shaders.
    GeometryStage: "geometry_stage", "geometry shaders (Vulkan)",
        VulkanFeature(|core| &mut core.geometry_shader);
    /// A 32-bit float depth buffer with 8 bits of stencil.
    StencilBuffer: "stencil_buffer", "a 32-bit float depth buffer with stencil",
        Wgpu(wgpu::Features::DEPTH32FLOAT_STENCIL8);
    /// A 24-bit depth buffer with 8 bits of stencil. wgpu takes 32 bits without a word where there are no 24.
    Depth24: "depth24", "a 24-bit depth buffer with stencil (Vulkan)",
        VulkanFormat(
            vk::Format::D24_UNORM_S8_UINT,
            vk::FormatFeatureFlags::from_raw(
                vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT.as_raw()
                    | vk::FormatFeatureFlags::SAMPLED_IMAGE.as_raw(),
            ),
        );
    /// Storage buffers written by the stages before the rasteriser.
    VertexStores: "vertex_stores", "storage buffers written before the rasteriser (Vulkan)",
        VulkanFeature(|core| &mut core.vertex_pipeline_stores_and_atomics);
    /// Stencil values that fragment shaders write.
    StencilExport: "stencil_export", "stencil values written by fragment shaders (Vulkan)",
        VulkanExtension(vk::EXT_SHADER_STENCIL_EXPORT_NAME, None);
    /// Draws that a value in a buffer leaves out.
    ConditionalRendering: "conditional_rendering", "conditional rendering (Vulkan)",
        VulkanExtension(vk::EXT_CONDITIONAL_RENDERING_NAME, Some(|| {
            features(|of: &mut vk::PhysicalDeviceConditionalRenderingFeaturesEXT<'_>| {
                vec![&mut of.conditional_rendering]
            })
        }));
    /// Colours of 32-bit floats that are blended.
    FloatBlending: "float_blending", "blending of 32-bit floats",
        Wgpu(wgpu::Features::FLOAT32_BLENDABLE);
    /// Task and mesh shaders, whose code needs what Vulkan 1.2 has.
    MeshStage: "mesh_stage", "task and mesh shaders (Vulkan)",
        VulkanExtension12(vk::EXT_MESH_SHADER_NAME, || {
            features(|of: &mut vk::PhysicalDeviceMeshShaderFeaturesEXT<'_>| {
                vec![&mut of.task_shader, &mut of.mesh_shader]
            })
        });
    /// Stencil values that fragment shaders read, those of a pixel one after the other.
    StencilInput: "stencil_input", "stencil values read in order by fragment shaders (Vulkan)",
        VulkanExtension(ash::ext::rasterization_order_attachment_access::NAME, Some(|| {
            features(|of: &mut vk::PhysicalDeviceRasterizationOrderAttachmentAccessFeaturesEXT<'_>| {
                vec![&mut of.rasterization_order_stencil_attachment_access]
            })
        }));
    /// Rays traced by any shader through acceleration structures of the device.
    RayQuery: "ray_query", "ray queries",
        Wgpu(wgpu::Features::EXPERIMENTAL_RAY_QUERY);
}

impl Serialize for Capability {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.id())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{Gpu, GpuOptions};

    #[test]
    fn ids_are_distinct_words_of_small_letters() {
        let ids: std::collections::BTreeSet<_> = Capability::ALL.iter().map(|c| c.id()).collect();
        assert_eq!(ids.len(), Capability::ALL.len());
        let is_plain = |id: &&str| {
            id.bytes()
                .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_')
        };
        assert!(ids.iter().all(is_plain), "{ids:?}");
    }

    /// Of each source one: each can be left out of a device without any other, and then is a reason.
    #[test]
    fn a_device_has_what_its_adapter_has_but_for_what_is_hidden() {
        let all = Gpu::open(&GpuOptions::default()).unwrap();
        for &hidden in Capability::ALL {
            let gpu = Gpu::open(&GpuOptions {
                hidden: vec![hidden],
                ..GpuOptions::default()
            })
            .unwrap();
            for &other in Capability::ALL {
                assert_eq!(gpu.has(other), all.has(other) && other != hidden);
            }
            let reason = gpu.check(hidden).unwrap_err();
            assert!(reason.contains(hidden.words()), "{reason}");
        }
    }
}
