//! needs: math/elementary
// Von Mises–Fisher distributions: twin of `vsgl-core/src/sg/vmf.rs`.

struct MeanLength {
    length: f32,
    complement: f32,
}

// `MeanLength::DIRECTION`.
const MEAN_LENGTH_DIRECTION: MeanLength = MeanLength(1.0, 0.0);

fn mean_length_from_length(value: f32) -> MeanLength {
    let length = clamp(value, 0.0, 1.0);
    return MeanLength(length, 1.0 - length);
}

fn mean_length_convolve(own: MeanLength, other: MeanLength) -> MeanLength {
    return MeanLength(
        own.length * other.length,
        (own.complement + other.complement) - own.complement * other.complement,
    );
}

fn vmf_mean(sharpness: f32) -> MeanLength {
    let k = min(sharpness, SHARPNESS_MAX);
    let near = min(k, 1.0);
    let square = near * near;
    let p = horner_mean_length(square);
    let length_near = p * near;
    let far = max(k, 1.0);
    let decay = elementary_exp(-2.0 * far);
    let complement_far = 1.0 / far - 2.0 * decay / (1.0 - decay);
    let small = k < 1.0;
    return MeanLength(
        select(1.0 - complement_far, length_near, small),
        select(complement_far, 1.0 - length_near, small),
    );
}

fn vmf_mean_length(sharpness: f32) -> f32 {
    return vmf_mean(sharpness).length;
}

fn vmf_mean_length_complement(sharpness: f32) -> f32 {
    return vmf_mean(sharpness).complement;
}

fn vmf_sharpness(mean: MeanLength) -> f32 {
    let r = mean.length;
    let s = r * r;
    let q = horner_sharpness_correction(s);
    return min(vmf_sharpness_banerjee_2005(mean) + r * s * q, SHARPNESS_MAX);
}

fn vmf_sharpness_exact(mean_length: MeanLength) -> f32 {
    let k = vmf_sharpness(mean_length);
    let at = vmf_mean(k);
    let far = max(k, 1.0);
    let decay = elementary_exp(-2.0 * far);
    let inverse = 1.0 / far;
    let slope_far = inverse * inverse - 4.0 * decay / ((1.0 - decay) * (1.0 - decay));
    let near = max(k, 1e-30);
    let slope_near = 1.0 - at.length * at.length - 2.0 * (at.length / near);
    let miss_near = mean_length.length - at.length;
    let miss_far = at.complement - max(mean_length.complement, COMPLEMENT_MIN);
    let step = select(miss_far / slope_far, miss_near / slope_near, k < 1.0);
    return clamp(k + step, 0.0, SHARPNESS_MAX);
}

fn vmf_convolve(a: f32, b: f32) -> f32 {
    return vmf_sharpness(mean_length_convolve(vmf_mean(a), vmf_mean(b)));
}

fn vmf_convolve_with(a: MeanLength, b: f32) -> f32 {
    return vmf_sharpness(mean_length_convolve(a, vmf_mean(b)));
}

fn vmf_sharpness_banerjee_2005(mean: MeanLength) -> f32 {
    let r = mean.length;
    return min(r * (3.0 - r * r) / (max(mean.complement, COMPLEMENT_MIN) * (1.0 + r)), SHARPNESS_MAX);
}

fn vmf_mean_banerjee_2005(sharpness: f32) -> MeanLength {
    let k = min(sharpness, SHARPNESS_MAX);
    let near = min(k, 1.0);
    var r = near * (1.0 / 3.0);
    for (var i = 0u; i < 3u; i += 1u) {
        let square = r * r;
        let value = r * (3.0 - square) - near * (1.0 - square);
        let slope = 3.0 * (1.0 - square) + 2.0 * near * r;
        r -= value / slope;
    }
    let far = max(k, 1.0);
    var c = 1.0 / (1.0 + far);
    for (var i = 0u; i < 4u; i += 1u) {
        let value = (1.0 - c) * (2.0 + c * (2.0 - c)) - far * c * (2.0 - c);
        let slope = 3.0 * c * (c - 2.0) - 2.0 * far * (1.0 - c);
        c -= value / slope;
    }
    let small = k < 1.0;
    return MeanLength(select(1.0 - c, r, small), select(c, 1.0 - r, small));
}

fn vmf_sharpness_toksvig_2005(mean: MeanLength) -> f32 {
    return min(mean.length / max(mean.complement, COMPLEMENT_MIN), SHARPNESS_MAX);
}

fn vmf_mean_toksvig_2005(sharpness: f32) -> MeanLength {
    let k = min(sharpness, SHARPNESS_MAX);
    let complement = 1.0 / (k + 1.0);
    return MeanLength(k * complement, complement);
}
