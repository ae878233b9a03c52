//! needs: data/partition
// Centres that clusters are gathered around, and boxes around these.

struct Centre {
    position: vec3<f32>,
    number: u32,
}

struct Bounds {
    low: vec3<f32>,
    high: vec3<f32>,
}
