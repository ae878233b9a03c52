//! The textures of a host, and whether they can be read.

use vsgl_core::glam::{DMat4, DVec3, Mat4, Vec3};
use vsgl_core::scene::Light;
use vsgl_core::{Error, Result};
use wgpu::{TextureFormat as Format, TextureView};

/// Where surfaces are, texel by texel.
#[derive(Clone, Copy, Debug)]
pub enum Place<'a> {
    /// The host's depth buffer, or a copy of it: `Depth32Float`, `Depth24Plus`, `Depth16Unorm` (of formats with stencil a view
    /// of the depth alone), `R32Float` or `R16Float`. The inverse view-projection says what depth means, so any convention will
    /// do: near to far, reversed, finite or infinite.
    Depth {
        /// One texel a sample.
        texture: &'a TextureView,
        /// Depth where there is nothing: what the buffer was cleared to.
        background: f32,
    },
    /// xyz: position in the world \[m\]; w: 0 where there is nothing. `Rgba32Float`; `Rgba16Float` has eleven bits, which is a
    /// millimetre a metre away from the origin.
    Position(&'a TextureView),
}

impl<'a> Place<'a> {
    pub(crate) fn texture(&self) -> &'a TextureView {
        match self {
            Self::Depth { texture, .. } | Self::Position(texture) => texture,
        }
    }
}

/// Shading normals in the world, of any length but zero, on either side of the surface.
#[derive(Clone, Copy, Debug)]
pub struct Normals<'a> {
    /// xyz in a format of four numbers: floats, `Rgba8Snorm`, or with `biased` `Rgba8Unorm` or `Rgb10a2Unorm`.
    pub texture: &'a TextureView,
    /// Whether −1 ..= 1 is stored as 0 ..= 1.
    pub biased: bool,
}

/// What a light's map holds for colour.
#[derive(Clone, Copy, Debug)]
pub enum Colors<'a> {
    /// Linear base colour, 0 ..= 1: the flux follows from the light and the texel's solid angle, and metals and glossy surfaces
    /// send their specular light.
    Base(&'a TextureView),
    /// Flux that each texel reflects \[W\], as in the reflective shadow maps of Dachsbacher and Stamminger 2005. All of it is
    /// taken for the Lambert part's.
    Flux(&'a TextureView),
}

/// Roughness as glTF has it (its square is GGX's `alpha`) and metalness, 0 ..= 1.
#[derive(Clone, Copy, Debug)]
pub enum Materials<'a> {
    /// In a texture.
    Texture {
        /// Any format of the base colour's.
        texture: &'a TextureView,
        /// Channel of the roughness, 0 ..= 3; 1 in glTF.
        roughness_channel: u8,
        /// Channel of the metalness, 0 ..= 3; 2 in glTF.
        metallic_channel: u8,
    },
    /// One for all surfaces.
    Constant {
        /// Roughness.
        roughness: f32,
        /// Metalness.
        metallic: f32,
    },
}

impl<'a> Materials<'a> {
    pub(crate) fn texture(&self) -> Option<&'a TextureView> {
        match self {
            Self::Texture { texture, .. } => Some(texture),
            Self::Constant { .. } => None,
        }
    }
}

/// What a host's camera sees, one sample a texel, all textures of one size, level 0.
#[derive(Clone, Copy, Debug)]
pub struct HostGBuffer<'a> {
    /// Where surfaces are.
    pub place: Place<'a>,
    /// Which way they face.
    pub normals: Normals<'a>,
    /// Linear base colour 0 ..= 1; a texture of sRGB is decoded as it is read.
    pub base_color: &'a TextureView,
    /// How they reflect.
    pub materials: Materials<'a>,
    /// From clip space to the world; read for [`Place::Depth`] alone.
    pub inverse_view_projection: Mat4,
    /// The eye in the world \[m\].
    pub eye: Vec3,
    /// Reflectance of what is no metal at normal incidence; 0.04 in glTF.
    pub dielectric_f0: f32,
}

/// What a light of the host sees, all textures square and of one size, level 0.
#[derive(Clone, Copy, Debug)]
pub struct HostMap<'a> {
    /// The light, a spot or a point, at the eye of the map. What lies outside a spot's cone is dark, wherever the map's borders are;
    /// faces around a point are maps of their own, and must neither overlap nor leave gaps.
    pub light: &'a Light,
    /// Where surfaces are.
    pub place: Place<'a>,
    /// Which way they face.
    pub normals: Normals<'a>,
    /// What they reflect.
    pub colors: Colors<'a>,
    /// How they reflect.
    pub materials: Materials<'a>,
    /// From the map's clip space to the world: of a perspective projection from the light's position.
    pub inverse_view_projection: Mat4,
    /// As in [`HostGBuffer`].
    pub dielectric_f0: f32,
}

/// Formats of colours and factors: four numbers or three, or one where that is all there is.
const COLORS: &[Format] = &[
    Format::Rgba8Unorm,
    Format::Rgba8UnormSrgb,
    Format::Bgra8Unorm,
    Format::Bgra8UnormSrgb,
    Format::Rgb10a2Unorm,
    Format::Rg11b10Ufloat,
    Format::Rgba16Float,
    Format::Rgba32Float,
];
const NORMALS: &[Format] = &[Format::Rgba8Snorm, Format::Rgba16Float, Format::Rgba32Float];
const BIASED: &[Format] = &[
    Format::Rgba8Unorm,
    Format::Rgb10a2Unorm,
    Format::Rgba16Float,
    Format::Rgba32Float,
];
const POSITIONS: &[Format] = &[Format::Rgba16Float, Format::Rgba32Float];
const DEPTHS: &[Format] = &[
    Format::Depth16Unorm,
    Format::Depth24Plus,
    Format::Depth24PlusStencil8,
    Format::Depth32Float,
    Format::Depth32FloatStencil8,
    Format::R16Float,
    Format::R32Float,
];

/// Whether textures have formats that are read, the usage for it, and one size.
pub(super) fn check(
    place: &Place<'_>,
    normals: &Normals<'_>,
    colors: &TextureView,
    materials: &Materials<'_>,
) -> Result<()> {
    let places = match place {
        Place::Depth { .. } => DEPTHS,
        Place::Position(_) => POSITIONS,
    };
    let signs = if normals.biased { BIASED } else { NORMALS };
    let mut all = vec![
        ("place", place.texture(), places),
        ("normals", normals.texture, signs),
        ("colors", colors, COLORS),
    ];
    all.extend(materials.texture().map(|t| ("materials", t, COLORS)));
    if let Materials::Texture {
        roughness_channel,
        metallic_channel,
        ..
    } = materials
        && *roughness_channel.max(metallic_channel) > 3
    {
        return Err(Error::setting(
            "materials",
            format!("channels {roughness_channel} and {metallic_channel}"),
            "channels are 0, 1, 2 and 3",
        ));
    }
    let size = place.texture().texture().size();
    for (name, view, formats) in all {
        let texture = view.texture();
        if !formats.contains(&texture.format()) {
            return Err(Error::setting(
                name,
                format!("a texture of the format {:?}", texture.format()),
                format!("give one of {formats:?}"),
            ));
        }
        let usage = wgpu::TextureUsages::TEXTURE_BINDING;
        if !texture.usage().contains(usage) || texture.sample_count() != 1 {
            return Err(Error::setting(
                name,
                "a texture that shaders cannot read, or of several samples",
                "make it with the usage TEXTURE_BINDING and one sample",
            ));
        }
        if (texture.width(), texture.height()) != (size.width, size.height) {
            return Err(Error::setting(
                name,
                format!("{}x{} texels", texture.width(), texture.height()),
                format!("the others have {}x{}", size.width, size.height),
            ));
        }
    }
    Ok(())
}

impl HostMap<'_> {
    /// Texels along a side.
    pub(crate) fn size(&self) -> u32 {
        self.place.texture().texture().width()
    }

    /// A plane across the view, as seen from the light: its place (0, 0) of clip space, and what one unit adds to it along each
    /// side.
    pub(crate) fn plane(&self) -> Result<[Vec3; 3]> {
        let (position, axis) = match self.light {
            Light::Spot(spot) => (spot.position, Some(spot.axis)),
            Light::Point(point) => (point.position, None),
            _ => {
                return Err(Error::setting(
                    "rsm",
                    "a map of a light without a position",
                    "give maps of spots and points; `trace_rsm` makes those of others",
                ));
            }
        };
        let matrix: DMat4 = self.inverse_view_projection.as_dmat4();
        // Half of the range of depth is a plane between near and far by every convention.
        let at = |x: f64, y: f64, z: f64| {
            matrix.project_point3(DVec3::new(x, y, z)) - position.as_dvec3()
        };
        let centre = at(0.0, 0.0, 0.5);
        let (across, upwards) = (at(1.0, 0.0, 0.5) - centre, at(0.0, 1.0, 0.5) - centre);
        let scale = centre.length();
        // The corners of the plane span it, and all planes are seen alike from the light alone.
        let corner = at(1.0, 1.0, 0.5);
        let other = at(1.0, 1.0, 0.25);
        let bent = corner.distance(centre + across + upwards);
        let aside = corner.normalize_or_zero().cross(other.normalize_or_zero());
        let facing = axis.map_or(1.0, |axis| centre.dot(axis.as_dvec3()));
        let sound = scale.is_finite() && bent <= 1e-3 * scale && aside.length() <= 1e-3;
        if !(sound && scale > 0.0 && other.length() > 0.0 && facing > 0.0) {
            return Err(Error::setting(
                "inverse_view_projection",
                "no perspective projection from the position of the light along its axis",
                "give the inverse of the matrix that the map was drawn by",
            ));
        }
        // Any scale will do: directions are what is read.
        Ok([centre, across, upwards].map(|v| (v / scale).as_vec3()))
    }
}
