// A cluster's extent as seen from a receiver: twin of `vsgl-core/src/sg/extent.rs`.

fn extent_along(covariance: array<f32, 6>, direction: vec3<f32>) -> f32 {
    let x = direction.x;
    let y = direction.y;
    let z = direction.z;
    let squares = covariance[0] * (x * x) + covariance[1] * (y * y) + covariance[2] * (z * z);
    let crossed = covariance[3] * (x * y) + covariance[4] * (x * z) + covariance[5] * (y * z);
    return max(squares + 2.0 * crossed, 0.0);
}

fn extent_along_flat(variance: f32, mean_length: f32, cosine: f32) -> f32 {
    let square = mean_length * mean_length;
    return variance * max(1.0 - (square * square) * (cosine * cosine), 0.0);
}
