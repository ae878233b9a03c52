//! Whether structs of shaders and their Rust twins lie in memory alike.

use wgpu::naga::{self, TypeInner};

/// Asserts that a struct of a shader has the members of its twin, at the same offsets.
macro_rules! twins {
    ($file:literal, $name:literal, $rust:ty { $($field:ident),* $(,)? }) => {
        $crate::layout::check(
            $file,
            $name,
            size_of::<$rust>(),
            &[$((stringify!($field), std::mem::offset_of!($rust, $field))),*],
        )
    };
}
pub(crate) use twins;

pub(crate) fn check(file: &str, name: &str, size: usize, fields: &[(&str, usize)]) {
    let source = crate::link(&[file]);
    let module = naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
    let found = module.types.iter().find_map(|(_, ty)| match &ty.inner {
        TypeInner::Struct { members, span } if ty.name.as_deref() == Some(name) => {
            Some((members, *span as usize))
        }
        _ => None,
    });
    let (members, span) = found.unwrap_or_else(|| panic!("{file} has no struct `{name}`"));
    let theirs: Vec<(&str, usize)> = members
        .iter()
        .map(|m| (m.name.as_deref().unwrap_or_default(), m.offset as usize))
        .collect();
    assert_eq!(theirs, fields, "{file}: {name}");
    assert_eq!(span, size, "{file}: size of {name}");
}

#[test]
fn records_of_the_scene_and_of_lights() {
    use crate::params::{TexelLayout, View};
    use vsgl_core::data::{
        DiffuseVsgl, EmitterRecord, LampRecord, LightRecord, MapRecord, MaterialRecord,
        SpecularVsgl, TextureRecord,
    };
    use vsgl_core::geom::BvhNode;

    twins!(
        "data/scene",
        "BvhNode",
        BvhNode {
            min,
            first,
            max,
            count
        }
    );
    twins!(
        "data/scene",
        "MaterialRecord",
        MaterialRecord {
            base_color,
            metallic,
            reflectance,
            specular,
            roughness,
            alpha,
            alpha_cutoff,
            flags,
            emission,
            normal_scale,
            anisotropy,
            anisotropy_cos,
            anisotropy_sin,
            base_color_texture,
            metallic_roughness_texture,
            normal_texture,
            emissive_texture,
            specular_texture,
            specular_color_texture,
            anisotropy_texture,
            padding,
        }
    );
    twins!(
        "data/scene",
        "TextureRecord",
        TextureRecord {
            first,
            width,
            height,
            mode,
            to_u,
            smaller,
            to_v,
            levels,
        }
    );
    twins!(
        "data/scene",
        "TexelLayout",
        TexelLayout {
            corner_texcoord,
            corner_texcoord_second,
            corner_tangent,
            corner_color,
            triangle_material,
            material,
            texture,
            texel,
            srgb,
            rows,
            padding,
        }
    );
    twins!(
        "data/view",
        "View",
        View {
            eye,
            tan_half_fov,
            forward,
            width,
            right,
            height,
            up,
            aa,
            stride,
            samples_x,
            samples_y,
            padding,
        }
    );
    twins!(
        "data/lights",
        "MapRecord",
        MapRecord {
            position,
            tan_half_fov,
            axis,
            cos_inner,
            right,
            cos_outer,
            up,
            solid_angle,
            intensity,
            kind,
            cone,
            inverse_range2,
        }
    );
    twins!(
        "data/emitters",
        "EmitterRecord",
        EmitterRecord {
            position,
            area,
            normal,
            triangle,
            flux,
            padding
        }
    );
    twins!(
        "data/emitters",
        "LampRecord",
        LampRecord {
            triangle,
            by_power,
            evenly,
            padding
        }
    );
    twins!(
        "data/lights",
        "LightRecord",
        LightRecord {
            position,
            cos_inner,
            axis,
            cos_outer,
            intensity,
            inverse_range2,
            parallel,
            passed,
            padding,
        }
    );
    twins!(
        "data/vsgls",
        "DiffuseVsgl",
        DiffuseVsgl {
            position,
            variance,
            axis,
            sharpness,
            intensity,
            complement,
            light,
            f0,
            covariance,
            f90,
            bulge,
        }
    );
    twins!(
        "data/vsgls",
        "SpecularVsgl",
        SpecularVsgl {
            position,
            variance,
            axis,
            complement,
            mirror,
            complement_mirror,
            light,
            sharpness_lobe,
            f0,
            alpha,
            f90,
            bulge,
            covariance,
            across,
            turn,
        }
    );
}

#[test]
fn strides_of_lights_are_their_sizes() {
    use vsgl_core::data::{DiffuseVsgl, SpecularVsgl, Target};
    let text = crate::link(&["data/vsgls"]);
    for (name, size) in [
        ("DIFFUSE_STRIDE", size_of::<DiffuseVsgl>()),
        ("SPECULAR_STRIDE", size_of::<SpecularVsgl>()),
        ("TARGET_STRIDE", size_of::<Target>()),
    ] {
        let line = format!("const {name}: u32 = {}u;", size / 16);
        assert!(text.contains(&line), "{line}");
    }
}
