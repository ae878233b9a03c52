// Vectors: twin of `vsgl-core/src/math/vec.rs`. The built-ins `normalize`, `length` and `reflect` are the driver's.

fn vec_normalize(v: vec3<f32>) -> vec3<f32> {
    let squared = dot(v, v);
    let zero = squared < F32_MIN_POSITIVE;
    let inverse = 1.0 / sqrt(select(squared, 1.0, zero));
    let unit = v * inverse;
    return select(unit, vec3(0.0, 0.0, 1.0), zero);
}

fn vec_one_minus_cos(a: vec3<f32>, b: vec3<f32>) -> f32 {
    let apart = a - b;
    return 0.5 * dot(apart, apart);
}

fn vec_reflect(direction: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return normal * (2.0 * dot(normal, direction)) - direction;
}

struct Basis {
    x: vec3<f32>,
    y: vec3<f32>,
}

fn vec_orthonormal_basis(z: vec3<f32>) -> Basis {
    let sign = select(1.0, -1.0, z.z < 0.0);
    let a = -1.0 / (sign + z.z);
    let b = z.x * z.y * a;
    let x = vec3(sign * (z.x * z.x * a) + 1.0, sign * b, -sign * z.x);
    let y = vec3(b, z.y * z.y * a + sign, -z.y);
    return Basis(x, y);
}

fn vec_luminance(rgb: vec3<f32>) -> f32 {
    return dot(rgb, vec3(LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE));
}
