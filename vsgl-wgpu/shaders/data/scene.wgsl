// Records of the scene. Twins of `vsgl-core/src/data/scene_data.rs` and `geom/traverse.rs`.

struct BvhNode {
    min: vec3<f32>,
    first: u32,
    max: vec3<f32>,
    count: u32,
}

// Textures are numbers of records, or NO_TEXTURE.
struct MaterialRecord {
    base_color: vec3<f32>,
    metallic: f32,
    reflectance: vec3<f32>,
    specular: f32,
    roughness: f32,
    alpha: f32,
    alpha_cutoff: f32,
    flags: u32,
    emission: vec3<f32>,
    normal_scale: f32,
    anisotropy: f32,
    anisotropy_cos: f32,
    anisotropy_sin: f32,
    base_color_texture: u32,
    metallic_roughness_texture: u32,
    normal_texture: u32,
    emissive_texture: u32,
    specular_texture: u32,
    specular_color_texture: u32,
    anisotropy_texture: u32,
    padding: vec2<u32>,
}

// Where a texture's texels lie among the words of `texels`, and how it is read.
struct TextureRecord {
    first: u32,
    width: u32,
    height: u32,
    mode: u32,
    to_u: vec3<f32>,
    smaller: u32,
    to_v: vec3<f32>,
    levels: u32,
}

// Where the columns of the scene begin among the words of `texels`; NO_WORDS where a column that a scene may lack is empty.
struct TexelLayout {
    corner_texcoord: u32,
    corner_texcoord_second: u32,
    corner_tangent: u32,
    corner_color: u32,
    triangle_material: u32,
    material: u32,
    texture: u32,
    texel: u32,
    srgb: u32,
    // Rows of a layer.
    rows: u32,
    padding: vec2<u32>,
}
