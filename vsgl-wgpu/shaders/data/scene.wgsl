// Records of the scene. Twins of `vsgl-core/src/data/scene_data.rs` and `geom/traverse.rs`.

struct BvhNode {
    min: vec3<f32>,
    first: u32,
    max: vec3<f32>,
    count: u32,
}

struct MaterialRecord {
    base_color: vec3<f32>,
    metallic: f32,
    dielectric_f0: vec3<f32>,
    dielectric_f90: f32,
    roughness: f32,
    base_color_texture: u32,
    metallic_roughness_texture: u32,
    padding: u32,
}

// Where a texture's texels lie among the words of `texels`, and how it is read.
struct TextureRecord {
    first: u32,
    width: u32,
    height: u32,
    mode: u32,
}

// Where the columns of the scene begin among the words of `texels`.
struct TexelLayout {
    texture: u32,
    texel: u32,
    srgb: u32,
    // Rows of a layer.
    rows: u32,
}
