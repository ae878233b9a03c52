//! What a host sees, and what its lights see, from its own textures.

use super::flag;
use crate::interop::{Colors, HostGBuffer, HostMap, Materials, Place};
use crate::kernel::{Constant, KernelId};
use crate::recorder::{Binding, Groups, Recorder};
use crate::res::WgpuRes;
use bytemuck::{Pod, Zeroable};
use vsgl_core::Result;
use vsgl_core::data::{GBuffer, MapRecord, Rsm, SceneData};
use vsgl_core::phase::rsm::around;
use vsgl_core::plan::{GBufferPlan, RsmPlan};

/// Twin of `Host` in `data/host.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Host {
    to_world: [[f32; 4]; 4],
    background: f32,
    roughness: f32,
    metallic: f32,
    roughness_channel: u32,
    metallic_channel: u32,
    dielectric_f0: f32,
    width: u32,
    height: u32,
    nodes: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

/// Twin of `Params` in `entry/import_gbuffer.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct GBufferParams {
    host: Host,
    eye: [f32; 3],
    padding: f32,
}

/// Twin of `Params` in `entry/import_rsm.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct RsmParams {
    host: Host,
    map: MapRecord,
    centre: [f32; 3],
    first: u32,
    across: [f32; 3],
    count: u32,
    upwards: [f32; 3],
    padding: u32,
}

/// What differs between hosts, as constants of the shaders.
#[derive(Clone, Copy, Debug)]
struct Kind {
    positions: bool,
    biased: bool,
    materials: bool,
    scene: bool,
}

impl Kind {
    fn constants(self, glossy: bool) -> Vec<Constant> {
        vec![
            ("GLOSSY", flag(glossy)),
            ("POSITIONS", flag(self.positions)),
            ("BIASED", flag(self.biased)),
            ("MATERIALS", flag(self.materials)),
            ("SCENE", flag(self.scene)),
        ]
    }
}

/// The kernels that hosts may need.
pub(crate) fn kernels() -> Vec<KernelId> {
    let mut kernels = Vec::new();
    for bits in 0..64u32 {
        let has = |bit: u32| bits >> bit & 1 == 1;
        let kind = Kind {
            positions: has(0),
            biased: has(1),
            materials: has(2),
            scene: has(3),
        };
        let mut constants = kind.constants(has(4));
        if !has(5) {
            kernels.push(KernelId::new(
                "entry/import_gbuffer",
                "import_gbuffer",
                &constants,
            ));
        }
        constants.push(("FLUX", flag(has(5))));
        kernels.push(KernelId::new("entry/import_rsm", "import_rsm", &constants));
    }
    kernels
}

impl Host {
    fn new(
        scene: &WgpuRes<SceneData>,
        place: &Place<'_>,
        materials: &Materials<'_>,
        to_world: [[f32; 4]; 4],
        dielectric_f0: f32,
    ) -> Self {
        let texture = place.texture().texture();
        let mut host = Self {
            to_world,
            background: match place {
                Place::Depth { background, .. } => *background,
                Place::Position(_) => 0.0,
            },
            roughness: 1.0,
            metallic: 0.0,
            roughness_channel: 0,
            metallic_channel: 0,
            dielectric_f0,
            width: texture.width(),
            height: texture.height(),
            nodes: scene.len("node") as u32,
            padding_a: 0,
            padding_b: 0,
            padding_c: 0,
        };
        match *materials {
            Materials::Texture {
                roughness_channel,
                metallic_channel,
                ..
            } => {
                host.roughness_channel = u32::from(roughness_channel);
                host.metallic_channel = u32::from(metallic_channel);
            }
            Materials::Constant {
                roughness,
                metallic,
            } => (host.roughness, host.metallic) = (roughness, metallic),
        }
        host
    }
}

fn bound<'a>(
    place: &Place<'a>,
    normals: &'a wgpu::TextureView,
    colors: &'a wgpu::TextureView,
    materials: &Materials<'a>,
    scene: &'a WgpuRes<SceneData>,
) -> Vec<(&'static str, Binding<'a>)> {
    vec![
        ("place", Binding::Texture(place.texture())),
        ("normals", Binding::Texture(normals)),
        ("colors", Binding::Texture(colors)),
        // Something must be bound, read or not.
        (
            "materials",
            Binding::Texture(materials.texture().unwrap_or(colors)),
        ),
        ("node", scene.bind("node")),
        ("corner", scene.bind("corner")),
        ("texels", scene.bind("texel")),
        ("columns", scene.layout()),
    ]
}

/// Records the import of a G-buffer; `scene` has triangles where `rays` are wanted.
pub(crate) fn gbuffer(
    recorder: &mut Recorder<'_>,
    from: &HostGBuffer<'_>,
    scene: &WgpuRes<SceneData>,
    rays: bool,
    plan: &GBufferPlan,
) -> Result<WgpuRes<GBuffer>> {
    let context = recorder.context();
    let to_world = from.inverse_view_projection.to_cols_array_2d();
    let host = Host::new(
        scene,
        &from.place,
        &from.materials,
        to_world,
        from.dielectric_f0,
    );
    let count = u64::from(host.width) * u64::from(host.height);
    let glossy = if plan.glossy { count } else { 0 };
    let made = WgpuRes::<GBuffer>::new(
        context,
        vec![host.width, host.height],
        &[
            ("triangle", 4, count),
            ("position", 16, count),
            ("normal", 16, count),
            ("diffuse", 16, count),
            ("specular", 16, glossy),
            ("grazing", 4, glossy),
            ("tangent", 16, 0),
            // The host draws it.
            ("emission", 12, 0),
        ],
    )?;
    let kind = Kind {
        positions: matches!(from.place, Place::Position(_)),
        biased: from.normals.biased,
        materials: from.materials.texture().is_some(),
        scene: rays,
    };
    let constants = kind.constants(plan.glossy);
    let kernel = context.kernel("entry/import_gbuffer", "import_gbuffer", &constants)?;
    let params = GBufferParams {
        host,
        eye: from.eye.to_array(),
        padding: 0.0,
    };
    let (normals, colors) = (from.normals.texture, from.base_color);
    let mut bound = bound(&from.place, normals, colors, &from.materials, scene);
    bound.extend([
        ("triangle_out", made.bind("triangle")),
        ("surface_out", made.bind("position")),
        ("grazing_out", made.bind("grazing")),
    ]);
    recorder.dispatch(&kernel, &params, &bound, Groups::Items(count))?;
    Ok(made)
}

/// Records the import of all maps; `scene` has triangles where `rays` are wanted.
pub(crate) fn rsm(
    recorder: &mut Recorder<'_>,
    from: &[HostMap<'_>],
    scene: &WgpuRes<SceneData>,
    rays: bool,
    plan: &RsmPlan,
) -> Result<WgpuRes<Rsm>> {
    let context = recorder.context();
    let size = from.first().map_or(1, HostMap::size);
    let maps = from.len() as u64;
    let side = u64::from(size) * u64::from(size);
    let count = side * maps;
    let glossy = if plan.glossy { count } else { 0 };
    let made = WgpuRes::<Rsm>::new(
        context,
        vec![size, from.len() as u32],
        &[
            ("map", size_of::<MapRecord>() as u64, maps),
            ("triangle", 4, count),
            ("position", 16, count),
            ("normal", 16, count),
            ("diffuse", 16, count),
            ("specular", 16, glossy),
            ("grazing", 16, glossy),
            ("tangent", 16, 0),
        ],
    )?;
    for (index, from) in from.iter().enumerate() {
        let plane = from.plane()?;
        let to_world = from.inverse_view_projection.to_cols_array_2d();
        let (colors, flux) = match from.colors {
            Colors::Base(texture) => (texture, false),
            Colors::Flux(texture) => (texture, true),
        };
        let kind = Kind {
            positions: matches!(from.place, Place::Position(_)),
            biased: from.normals.biased,
            materials: from.materials.texture().is_some(),
            scene: rays,
        };
        let mut constants = kind.constants(plan.glossy);
        constants.push(("FLUX", flag(flux)));
        let kernel = context.kernel("entry/import_rsm", "import_rsm", &constants)?;
        let params = RsmParams {
            host: Host::new(
                scene,
                &from.place,
                &from.materials,
                to_world,
                from.dielectric_f0,
            ),
            map: around(from.light, size),
            centre: plane[0].to_array(),
            first: (index as u64 * side) as u32,
            across: plane[1].to_array(),
            count: count as u32,
            upwards: plane[2].to_array(),
            padding: 0,
        };
        let mut bound = bound(
            &from.place,
            from.normals.texture,
            colors,
            &from.materials,
            scene,
        );
        bound.extend([
            ("triangle_out", made.bind("triangle")),
            ("texel_out", made.bind("position")),
            ("map_out", made.bind("map")),
        ]);
        recorder.dispatch(&kernel, &params, &bound, Groups::Items(side))?;
    }
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::{GBufferParams, Host, RsmParams};
    use crate::layout::twins;

    #[test]
    fn parameters_lie_alike() {
        twins!(
            "entry/import_gbuffer",
            "Host",
            Host {
                to_world,
                background,
                roughness,
                metallic,
                roughness_channel,
                metallic_channel,
                dielectric_f0,
                width,
                height,
                nodes,
                padding_a,
                padding_b,
                padding_c,
            }
        );
        twins!(
            "entry/import_gbuffer",
            "Params",
            GBufferParams { host, eye, padding }
        );
        twins!(
            "entry/import_rsm",
            "Params",
            RsmParams {
                host,
                map,
                centre,
                first,
                across,
                count,
                upwards,
                padding,
            }
        );
    }
}
