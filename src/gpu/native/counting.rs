//! How pipelines count: in the stencil, by its tests or by fragment shaders, or by blending what these give.

use crate::gpu::DepthDirection;
use ash::vk;

/// Where the pipelines over a target count.
#[derive(Debug, Clone)]
pub enum CountIn {
    /// In the stencil buffer, by its tests: one up or one down.
    Stencil,
    /// In the stencil buffer, whose values fragment shaders read at [`STENCIL_BINDING`](super::STENCIL_BINDING) and
    /// write, one after the other. It must be one that [`depth_stencil_input`](super::depth_stencil_input) has made.
    StencilInShaders,
    /// In a texture with one float a pixel, of the size of the depth buffer: what fragment shaders give is added to it.
    Blended(wgpu::Texture),
}

impl CountIn {
    pub(in crate::gpu) fn texture(&self) -> Option<&wgpu::Texture> {
        match self {
            Self::Blended(texture) => Some(texture),
            Self::Stencil | Self::StencilInShaders => None,
        }
    }
}

/// What happens to the primitives that the last shader before the rasteriser leaves.
///
/// Where the stencil counts by its tests, it wraps around: back faces add one and front faces take one away. Where it is
/// written by fragment shaders, it changes in the same places, and where counts are blended, fragment shaders run in these
/// alone. Front faces wind counter-clockwise in y-up clip space. Depth is never written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Raster {
    /// Count where the depth test (nearer than what is there) fails: z-fail.
    CountDepthFails,
    /// Count where the depth test passes, with opposite signs: z-pass.
    CountDepthPasses,
    /// Count everywhere.
    CountAll,
    /// Nothing is drawn; the shaders' side effects are all.
    Discard,
}

/// Tests of depth and stencil.
pub(super) fn tests(
    raster: Raster,
    direction: DepthDirection,
    counts: &CountIn,
) -> vk::PipelineDepthStencilStateCreateInfo<'static> {
    let (up, down) = (
        vk::StencilOp::INCREMENT_AND_WRAP,
        vk::StencilOp::DECREMENT_AND_WRAP,
    );
    match counts {
        CountIn::Stencil => stencil_tests(raster, direction, (up, down)),
        CountIn::StencilInShaders => {
            let shaders = vk::StencilOp::REPLACE;
            stencil_tests(raster, direction, (shaders, shaders)).flags(
                vk::PipelineDepthStencilStateCreateFlags::RASTERIZATION_ORDER_ATTACHMENT_STENCIL_ACCESS_EXT,
            )
        }
        CountIn::Blended(_) => depth_tests(raster, direction),
    }
}

fn tests_depth(raster: Raster) -> bool {
    matches!(raster, Raster::CountDepthFails | Raster::CountDepthPasses)
}

/// Over a whole closed volume that nothing clips, back faces and front faces count to zero; so what
/// fails the depth test counts as much as what passes it, with the opposite sign.
fn stencil_tests(
    raster: Raster,
    direction: DepthDirection,
    (up, down): (vk::StencilOp, vk::StencilOp),
) -> vk::PipelineDepthStencilStateCreateInfo<'static> {
    let count = |operation| {
        let (pass_op, depth_fail_op) = match raster {
            Raster::CountDepthFails => (vk::StencilOp::KEEP, operation),
            // Without a depth test, every fragment passes it.
            Raster::CountDepthPasses | Raster::CountAll | Raster::Discard => {
                (operation, vk::StencilOp::KEEP)
            }
        };
        vk::StencilOpState {
            fail_op: vk::StencilOp::KEEP,
            pass_op,
            depth_fail_op,
            compare_op: vk::CompareOp::ALWAYS,
            compare_mask: 0xff,
            write_mask: 0xff,
            reference: 0,
        }
    };
    let (front, back) = match raster {
        Raster::CountDepthPasses => (up, down),
        Raster::CountDepthFails | Raster::CountAll | Raster::Discard => (down, up),
    };
    vk::PipelineDepthStencilStateCreateInfo::default()
        .depth_test_enable(tests_depth(raster))
        .depth_compare_op(match direction {
            DepthDirection::Reversed => vk::CompareOp::GREATER,
            DepthDirection::Standard => vk::CompareOp::LESS,
        })
        .stencil_test_enable(true)
        .front(count(front))
        .back(count(back))
}

/// Depth tests that let a fragment shader run where the stencil would have counted.
fn depth_tests(
    raster: Raster,
    direction: DepthDirection,
) -> vk::PipelineDepthStencilStateCreateInfo<'static> {
    let is_nearer = match direction {
        DepthDirection::Reversed => vk::CompareOp::GREATER,
        DepthDirection::Standard => vk::CompareOp::LESS,
    };
    let is_not_nearer = match direction {
        DepthDirection::Reversed => vk::CompareOp::LESS_OR_EQUAL,
        DepthDirection::Standard => vk::CompareOp::GREATER_OR_EQUAL,
    };
    vk::PipelineDepthStencilStateCreateInfo::default()
        .depth_test_enable(tests_depth(raster))
        .depth_compare_op(match raster {
            Raster::CountDepthFails => is_not_nearer,
            Raster::CountDepthPasses | Raster::CountAll | Raster::Discard => is_nearer,
        })
}

/// Blending that adds the shader's number to the target's.
pub(super) fn addition() -> vk::PipelineColorBlendAttachmentState {
    vk::PipelineColorBlendAttachmentState::default()
        .blend_enable(true)
        .src_color_blend_factor(vk::BlendFactor::ONE)
        .dst_color_blend_factor(vk::BlendFactor::ONE)
        .color_blend_op(vk::BlendOp::ADD)
        .src_alpha_blend_factor(vk::BlendFactor::ONE)
        .dst_alpha_blend_factor(vk::BlendFactor::ONE)
        .alpha_blend_op(vk::BlendOp::ADD)
        .color_write_mask(vk::ColorComponentFlags::R)
}
