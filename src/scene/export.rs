//! Writes a scene as a scene file with an OBJ file beside it.

use std::collections::HashSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};

use super::view::radians;
use super::{CameraPath, LightKey, LightKeys, LightPath, Mesh, Scene, SceneError, SceneFile, Sun};
use crate::output;

/// Why a scene could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// It has no triangle, and there are no OBJ files without.
    #[error("a scene without triangles cannot be written")]
    NoTriangles,
    /// A position is NaN or infinite.
    #[error("vertex {0} is not at a finite place")]
    NotFinite(usize),
    /// Its light or its camera is none that a scene file may have.
    #[error("the scene cannot be written as a scene file")]
    Invalid(#[source] Box<SceneError>),
    /// The system refuses.
    #[error(transparent)]
    Write(#[from] anyhow::Error),
}

/// Writes `<stem>.obj` and `<stem>.toml` into `dir`, which is made if it is missing, and returns the path of
/// the latter.
///
/// Read back, the scene has the same light, the same camera and the same mesh, all to the bit, if its mesh was
/// made of [`Part`](super::Part)s. Any other mesh comes back as [`Mesh::filtered`] leaves it: the same
/// triangles in the same order and at the same places, with vertices numbered anew. Names of objects lose
/// characters that are none of letters, digits, `_`, `-` and `.`, and receivers have other names than
/// casters. The scene is then called `stem`.
///
/// # Errors
/// When there are no triangles, when a scene file could not hold the light or the camera, or when the files
/// cannot be written.
pub fn write(scene: &Scene, dir: &Path, stem: &str) -> Result<PathBuf, ExportError> {
    let finite = |p: &Vec3| p.is_finite();
    if let Some(vertex) = scene.mesh.positions.iter().position(|p| !finite(p)) {
        return Err(ExportError::NotFinite(vertex));
    }
    let mesh = scene.mesh.filtered(|_| true);
    if mesh.triangles.is_empty() {
        return Err(ExportError::NoTriangles);
    }
    let names = names(&mesh);
    let text = scene_text(scene, &mesh, &names, stem);
    let path = dir.join(format!("{stem}.toml"));
    // Reading decides what is valid.
    SceneFile::parse(&text, &path.to_string_lossy())
        .map_err(|error| ExportError::Invalid(Box::new(error)))?;
    output::create_dir_all(dir)?;
    let model = dir.join(format!("{stem}.obj"));
    output::write_atomically(&model, obj_text(&mesh, &names))?;
    output::write_atomically(&path, text)?;
    Ok(path)
}

/// A name for each object that an OBJ file can hold; no receiver is called like a caster.
fn names(mesh: &Mesh) -> Vec<String> {
    let casters: HashSet<String> = mesh.casters().map(|o| safe_name(&o.name)).collect();
    let name = |object: &super::Object| {
        let mut name = safe_name(&object.name);
        while !object.casts_shadow && casters.contains(&name) {
            name.push('_');
        }
        name
    };
    mesh.objects.iter().map(name).collect()
}

fn safe_name(name: &str) -> String {
    let safe = |c: char| {
        let keep = c.is_alphanumeric() || matches!(c, '_' | '-' | '.');
        if keep { c } else { '_' }
    };
    match name {
        "" => "object".to_owned(),
        name => name.chars().map(safe).collect(),
    }
}

fn obj_text(mesh: &Mesh, names: &[String]) -> String {
    let mut text = String::new();
    for (object, name) in mesh.objects.iter().zip(names) {
        // Writing to a String does not fail.
        let _ = writeln!(text, "o {name}");
        for p in &mesh.positions[object.vertex_range()] {
            let _ = writeln!(text, "v {:?} {:?} {:?}", p.x, p.y, p.z);
        }
        for triangle in &mesh.triangles[object.triangle_range()] {
            let [a, b, c] = triangle.map(|vertex| u64::from(vertex) + 1);
            let _ = writeln!(text, "f {a} {b} {c}");
        }
    }
    text
}

fn scene_text(scene: &Scene, mesh: &Mesh, names: &[String], stem: &str) -> String {
    let quoted = |text: &str| toml::Value::from(text).to_string();
    let mut known = HashSet::new();
    let objects = mesh.objects.iter().zip(names);
    let receivers: Vec<_> = objects
        .filter(|(object, name)| !object.casts_shadow && known.insert(name.as_str()))
        .map(|(_, name)| quoted(name))
        .collect();
    format!(
        "title = {}\n\n\
         [mesh]\nkind = \"obj\"\nfile = {}\nup = \"y\"\nreceivers = [{}]\n\n\
         [expect]\ntriangles = {}\nobjects = {}\n\n\
         {}\n\
         {}",
        quoted(&scene.title),
        quoted(&format!("{stem}.obj")),
        receivers.join(", "),
        mesh.caster_triangle_count(),
        mesh.caster_object_count(),
        light_text(&scene.flight.light),
        camera_text(&scene.flight.camera),
    )
}

fn light_text(light: &LightPath) -> String {
    match light {
        LightPath::Keys(keys) => keys_text(keys),
        LightPath::Sun(sun) => sun_text(sun),
    }
}

fn sun_text(sun: &Sun) -> String {
    let vector = |v: DVec3| format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z);
    let (site, compass, course) = (sun.site(), sun.compass(), sun.course());
    let times = match course.from == course.to {
        true => format!("time = \"{}\"", course.from),
        false => format!(
            "from = \"{}\"\nto = \"{}\"\nduration_s = {:?}",
            course.from, course.to, course.duration_s
        ),
    };
    format!(
        "[light.sun]\nlatitude = {:?}\nlongitude = {:?}\ndate = \"{}\"\nzone = {}\n{times}\n\
         north = {}\nup = {}\n",
        site.latitude_deg(),
        site.longitude_deg(),
        course.day.date(),
        toml::Value::from(course.day.zone_name()),
        vector(compass.north()),
        vector(compass.up()),
    )
}

fn keys_text(light: &LightKeys) -> String {
    let mut text = "[light]\n".to_owned();
    // Writing to a String does not fail.
    let _ = match &light.keys[..] {
        [key] if key.time_s == 0.0 => writeln!(text, "position = {}", array(key.place)),
        keys => {
            let key = |key: &LightKey| {
                let place = array(key.place);
                format!("  {{ time_s = {:?}, position = {place} }},\n", key.time_s)
            };
            let keys: String = keys.iter().map(key).collect();
            writeln!(text, "keys = [\n{keys}]")
        }
    };
    let _ = writeln!(text, "w = {}", number(light.w));
    text
}

fn camera_text(camera: &CameraPath) -> String {
    let mut text = format!(
        "[camera]\nfov_deg = {}\nnear = {}\nup = {}\nkeys = [\n",
        degrees(camera.fov_y_rad),
        number(camera.near),
        array(camera.up),
    );
    for key in &camera.keys {
        // Writing to a String does not fail.
        let _ = writeln!(
            text,
            "  {{ time_s = {:?}, eye = {}, target = {} }},",
            key.time_s,
            array(key.eye),
            array(key.target),
        );
    }
    text + "]\n"
}

fn array(v: Vec3) -> String {
    let [x, y, z] = v.to_array().map(number);
    format!("[{x}, {y}, {z}]")
}

/// The shortest text that a reader of 64-bit numbers turns into this one.
fn number(x: f32) -> String {
    if x.is_nan() {
        return "nan".to_owned();
    }
    let short = format!("{x:?}");
    // It is the shortest for readers of 32 bits. With 64 bits in between, it is rounded twice.
    match short.parse::<f64>() {
        Ok(read) if read as f32 == x => short,
        _ => format!("{:?}", f64::from(x)),
    }
}

/// The shortest degrees that are read as this number of radians.
fn degrees(radians_wanted: f32) -> String {
    const MAX_DECIMALS: usize = 15;
    let exact = f64::from(radians_wanted).to_degrees();
    let gives_it = |text: &String| text.parse().is_ok_and(|deg| radians(deg) == radians_wanted);
    (1..=MAX_DECIMALS)
        .map(|decimals| format!("{exact:.decimals$}"))
        .find(gives_it)
        .unwrap_or_else(|| format!("{exact:?}"))
}

#[cfg(test)]
#[path = "export_tests.rs"]
mod tests;
