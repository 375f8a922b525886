//! Shader sources: embedded in the program, joined from files by `#include`, compiled.
//!
//! WGSL and GLSL share one include mechanism: a line `#include "path/below/shaders"` is replaced by
//! that file, once per shader.

use include_dir::{Dir, include_dir};
use std::collections::{BTreeSet, HashMap};
use std::sync::{LazyLock, Mutex, PoisonError};

static SHADERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders");

/// The source at `path` below `shaders/` with all includes resolved, each file at most once.
///
/// # Panics
/// When a file is missing: sources are part of the program, so that is a bug.
pub fn source(path: &str) -> String {
    with_includes(file(path), BTreeSet::from([path.to_owned()]))
}

/// A text with all its includes resolved, each file at most once and none of those seen before.
fn with_includes(text: &str, mut seen: BTreeSet<String>) -> String {
    let mut joined = String::new();
    append(text, &mut seen, &mut joined);
    joined
}

fn file(path: &str) -> &'static str {
    let file = SHADERS.get_file(path).and_then(|file| file.contents_utf8());
    let Some(file) = file else {
        panic!("shader source `{path}` is not part of the program")
    };
    file
}

fn append(source: &str, seen: &mut BTreeSet<String>, text: &mut String) {
    for line in source.lines() {
        match line
            .trim()
            .strip_prefix("#include \"")
            .and_then(|rest| rest.strip_suffix('"'))
        {
            Some(included) => {
                if seen.insert(included.to_owned()) {
                    append(file(included), seen, text);
                }
            }
            None => {
                text.push_str(line);
                text.push('\n');
            }
        }
    }
}

/// A hash over every shader file, for the provenance of results.
pub fn hash() -> String {
    let mut hasher = blake3::Hasher::new();
    hash_dir(&SHADERS, &mut hasher);
    hasher.finalize().to_hex().to_string()
}

fn hash_dir(dir: &Dir<'_>, hasher: &mut blake3::Hasher) {
    for file in dir.files() {
        hasher.update(file.path().to_string_lossy().as_bytes());
        hasher.update(file.contents());
    }
    for sub in dir.dirs() {
        hash_dir(sub, hasher);
    }
}

/// A wgpu shader module of the WGSL file at `path`.
pub fn wgsl(device: &wgpu::Device, path: &str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(path),
        source: wgpu::ShaderSource::Wgsl(source(path).into()),
    })
}

/// A wgpu shader module of a method from outside of this crate: `text` may include the files of `shaders/`.
pub fn wgsl_text(device: &wgpu::Device, label: &str, text: &str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(with_includes(text, BTreeSet::new()).into()),
    })
}

/// A stage that GLSL sources are compiled for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GlslStage {
    /// Vertex shader, `*.vert`.
    Vertex,
    /// Tessellation control shader, `*.tesc`.
    TessellationControl,
    /// Tessellation evaluation shader, `*.tese`.
    TessellationEvaluation,
    /// Geometry shader, `*.geom`.
    Geometry,
    /// Fragment shader, `*.frag`.
    Fragment,
    /// Task shader, `*.task`.
    Task,
    /// Mesh shader, `*.mesh`.
    Mesh,
}

impl GlslStage {
    /// The stage that a file's ending stands for.
    fn of_path(path: &str) -> Option<Self> {
        Some(match path.rsplit('.').next()? {
            "vert" => Self::Vertex,
            "tesc" => Self::TessellationControl,
            "tese" => Self::TessellationEvaluation,
            "geom" => Self::Geometry,
            "frag" => Self::Fragment,
            "task" => Self::Task,
            "mesh" => Self::Mesh,
            _ => return None,
        })
    }
}

/// One compiled GLSL stage.
#[derive(Debug, Clone)]
pub struct Spirv {
    /// Which stage it is for.
    pub stage: GlslStage,
    /// The code.
    pub words: Vec<u32>,
}

/// What was compiled before, by path and definitions: the same few shaders serve every scene.
static COMPILED: LazyLock<Mutex<Compiled>> = LazyLock::new(Mutex::default);

type Compiled = HashMap<(String, String), Vec<u32>>;

/// Compiles the GLSL file at `path` (its ending names the stage) with `defines` set before it.
///
/// # Panics
/// When it does not compile: sources are part of the program, so that is a bug.
pub fn glsl(path: &str, defines: &[(&str, u32)]) -> Spirv {
    let Some(stage) = GlslStage::of_path(path) else {
        panic!("`{path}` names no shader stage")
    };
    let defines: String = defines
        .iter()
        .map(|(name, value)| format!("#define {name} {value}\n"))
        .collect();
    let key = (path.to_owned(), defines);
    let mut compiled = COMPILED.lock().unwrap_or_else(PoisonError::into_inner);
    let words = compiled.entry(key).or_insert_with_key(|(_, defines)| {
        match compile(stage, path, defines) {
            Ok(words) => words,
            Err(error) => panic!("{path} does not compile:\n{error}"),
        }
    });
    Spirv {
        stage,
        words: words.clone(),
    }
}

fn compile(
    stage: GlslStage,
    path: &str,
    defines: &str,
) -> Result<Vec<u32>, Box<dyn std::error::Error>> {
    use glslang::{
        Compiler, CompilerOptions, Shader, ShaderInput, ShaderSource, ShaderStage, SourceLanguage,
        SpirvVersion, Target, VulkanVersion,
    };
    let stage = match stage {
        GlslStage::Vertex => ShaderStage::Vertex,
        GlslStage::TessellationControl => ShaderStage::TesselationControl,
        GlslStage::TessellationEvaluation => ShaderStage::TesselationEvaluation,
        GlslStage::Geometry => ShaderStage::Geometry,
        GlslStage::Fragment => ShaderStage::Fragment,
        GlslStage::Task => ShaderStage::Task,
        GlslStage::Mesh => ShaderStage::Mesh,
    };
    // Devices with task and mesh shaders have the later versions, which these want.
    let (vulkan_version, spirv_version) = match stage {
        ShaderStage::Task | ShaderStage::Mesh => (VulkanVersion::Vulkan1_2, SpirvVersion::SPIRV1_4),
        _ => (VulkanVersion::Vulkan1_1, SpirvVersion::SPIRV1_3),
    };
    let compiler = Compiler::acquire().ok_or("the GLSL compiler could not be started")?;
    let text = format!("#version 450\n{defines}{}", source(path));
    let options = CompilerOptions {
        source_language: SourceLanguage::GLSL,
        target: Target::Vulkan {
            version: vulkan_version,
            spirv_version,
        },
        ..Default::default()
    };
    let text = ShaderSource::from(text);
    let no_defines = None::<&[(&str, Option<&str>)]>;
    let input = ShaderInput::new(&text, stage, &options, no_defines, None)?;
    Ok(Shader::new(compiler, input).parse()?.compile()?)
}
