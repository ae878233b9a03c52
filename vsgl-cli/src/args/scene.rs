//! Arguments that choose the scene, its lights, the camera and the size of the picture.

use super::settings::key_value;
use super::words::{LookAt, Point, Size, Spot, Sun, field_of_view, seconds};
use clap::Args;
use vsgl_core::scene::gltf::Limits;

/// Scene, lights and camera.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Scene, camera and lights")]
pub struct SceneArgs {
    /// glTF 2.0 file (.gltf, .glb), or sample:NAME for a scene made in code
    #[arg(value_name = "SCENE")]
    pub scene: Option<String>,
    /// Scene of a file that holds several, by name or by index from 0 [default: the one that the file names]
    #[arg(long = "scene", id = "scene_of_file", value_name = "NAME|INDEX")]
    pub part: Option<String>,
    /// Show the file as its animations have it at this time [default: at rest]
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true, value_parser = seconds)]
    pub time: Option<f64>,
    /// Accept more, or less, of something in the file than usual (repeatable); --help lists what
    #[arg(long, value_name = "NAME=VALUE", value_parser = key_value, long_help = limits_help())]
    pub limit: Vec<(String, String)>,
    /// Camera of the scene, by name or by index from 0 [default: the first]
    #[arg(long, value_name = "NAME|INDEX", conflicts_with = "look_at")]
    pub camera: Option<String>,
    /// Camera at ex,ey,ez that looks at tx,ty,tz, in world space, in metres
    #[arg(long, value_name = "ex,ey,ez:tx,ty,tz", value_parser = LookAt::parse, allow_hyphen_values = true)]
    pub look_at: Option<LookAt>,
    /// Vertical field of view of --look-at [default: 45]
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = field_of_view, requires = "look_at")]
    pub fov: Option<f64>,
    /// Add a spot light at px,py,pz that points at tx,ty,tz (repeatable)
    ///
    /// I is the radiant intensity on the axis in W/sr, one number or r,g,b. OUTER and INNER are half angles in degrees
    /// with the falloff of KHR_lights_punctual; without INNER the edge is hard.
    #[arg(long, value_name = "px,py,pz:tx,ty,tz:I:OUTER[:INNER]", value_parser = Spot::parse, allow_hyphen_values = true)]
    pub spot: Vec<Spot>,
    /// Add a point light at px,py,pz of the radiant intensity I in W/sr, one number or r,g,b (repeatable)
    #[arg(long, value_name = "px,py,pz:I", value_parser = Point::parse, allow_hyphen_values = true)]
    pub point: Vec<Point>,
    /// Add a directional light that travels along dx,dy,dz (repeatable)
    ///
    /// E is the irradiance of a surface that faces it in W/m², one number or r,g,b.
    #[arg(long, value_name = "dx,dy,dz:E", value_parser = Sun::parse, allow_hyphen_values = true)]
    pub sun: Vec<Sun>,
    /// Switch the scene's own lights off, and the surfaces that shine
    #[arg(long)]
    pub only_added_lights: bool,
}

/// What `--limit` can be given.
fn limits_help() -> String {
    let mut help = "Accept more, or less, of something in the file than usual (repeatable)\n\n\
        A file that asks for more is refused. The usual limits keep the memory for a hostile file below a gigabyte:"
        .to_owned();
    let about = Limits::NAMES.iter().map(|(_, about)| about);
    for ((name, value), about) in Limits::default().entries().into_iter().zip(about) {
        help += &format!("\n  {name}={value}: {about}");
    }
    help
}

/// Size and samples.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Picture")]
pub struct ViewArgs {
    /// Size of the picture in pixels [default: 640x360]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = Size::parse)]
    pub size: Option<Size>,
    /// N by N samples in each pixel [default: 1]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub aa: Option<u32>,
    /// Render every Nth pixel of every Nth row of that size; the output is N times smaller [default: 1]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub stride: Option<u32>,
    /// Seed of random numbers, which the method `path` alone draws [default: 0]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub seed: Option<u64>,
}
