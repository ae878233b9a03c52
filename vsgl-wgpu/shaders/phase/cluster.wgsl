//! needs: data/lights, data/vsgls, math/moments, math/vec, phase/facing, sg/anisotropic, sg/cosine, sg/lobe, sg/vmf
// Clusters of virtual point lights, and the lights that stand for them. Twin of `vsgl-core/src/phase/cluster.rs`.
//
// Reads the columns of the RSM, one after the other, from `texel`, and `map`, which the entry binds; for targets also
// `triangle` and `corner`. The entry declares the overrides GLOSSY, ANISOTROPIC, SG, APART, TOKSVIG and TRACE.

struct Sum {
    diffuse: Part,
    specular: Part,
    power: vec3<f32>,
    alpha2: f32,
    f0: vec3<f32>,
    f90: vec3<f32>,
    dielectric: vec2<f32>,
    mirror: Moments,
    lobe: vec3<f32>,
}

struct Part {
    weight: f32,
    position: Scatter,
    normal: Moments,
    bulge: f32,
    area: f32,
}

fn part_texel(weight: f32, position: vec3<f32>, normal: vec3<f32>, area: f32) -> Part {
    return Part(weight, scatter_point(position), moments_point(normal), 0.0, weight * area);
}

fn part_merge(own: Part, other: Part) -> Part {
    let weight = own.weight + other.weight;
    let share = own.weight * (other.weight / max(weight, F32_MIN_POSITIVE));
    let apart = other.position.mean - own.position.mean;
    let turned = other.normal.mean - own.normal.mean;
    return Part(
        weight,
        scatter_merge(own.position, own.weight, other.position, other.weight),
        moments_merge(own.normal, own.weight, other.normal, other.weight),
        own.bulge + other.bulge + dot(apart, turned) * share,
        own.area + other.area,
    );
}

fn part_scaled(own: Part, factor: f32) -> Part {
    return Part(
        own.weight * factor,
        scatter_scaled(own.position, factor),
        moments_scaled(own.normal, factor),
        own.bulge * factor,
        own.area * factor,
    );
}

struct Facing {
    axis: vec3<f32>,
    mean: MeanLength,
}

fn part_facing(own: Part) -> Facing {
    return cluster_facing(own.normal, own.weight);
}

fn cluster_facing(directions: Moments, weight: f32) -> Facing {
    let scatter = clamp(directions.spread / max(weight, F32_MIN_POSITIVE), 0.0, 1.0);
    let length = sqrt(1.0 - scatter);
    return Facing(vec_normalize(directions.mean), MeanLength(length, scatter / (1.0 + length)));
}

// `count` texels in all maps, `map_texels` in each.
fn sum_texel(index: u32, count: u32, map_texels: u32) -> Sum {
    let place = texel[index];
    let position = place.xyz;
    let turned = texel[count + index];
    let normal = turned.xyz;
    let lambert = texel[2u * count + index];
    let diffuse = vec_luminance(lambert.xyz);
    var sum = Sum();
    sum.diffuse = part_texel(diffuse, position, normal, place.w);
    sum.power = lambert.xyz;
    sum.dielectric = vec2(diffuse * lambert.w, diffuse * turned.w);
    if GLOSSY {
        let near = texel[3u * count + index];
        let grazing = texel[4u * count + index];
        var alpha = near.w;
        if ANISOTROPIC {
            alpha = sqrt(near.w * texel[5u * count + index].w);
        }
        let specular = grazing.w;
        let light = vec_normalize(map_record_to_light(map[index / map_texels], position));
        let mirror = vec_normalize(vec_reflect(light, normal));
        sum.specular = part_texel(specular, position, normal, place.w);
        sum.f0 = near.xyz;
        sum.f90 = grazing.xyz;
        sum.alpha2 = specular * (alpha * alpha);
        sum.mirror = moments_point(mirror);
        sum.lobe = mirror * (specular * cluster_lobe_length(alpha, dot(mirror, normal)));
    }
    return sum;
}

fn sum_merge(own: Sum, other: Sum) -> Sum {
    return Sum(
        part_merge(own.diffuse, other.diffuse),
        part_merge(own.specular, other.specular),
        own.power + other.power,
        own.alpha2 + other.alpha2,
        own.f0 + other.f0,
        own.f90 + other.f90,
        own.dielectric + other.dielectric,
        moments_merge(own.mirror, own.specular.weight, other.mirror, other.specular.weight),
        own.lobe + other.lobe,
    );
}

fn sum_scaled(own: Sum, factor: f32) -> Sum {
    return Sum(
        part_scaled(own.diffuse, factor),
        part_scaled(own.specular, factor),
        own.power * factor,
        own.alpha2 * factor,
        own.f0 * factor,
        own.f90 * factor,
        own.dielectric * factor,
        moments_scaled(own.mirror, factor),
        own.lobe * factor,
    );
}

fn sum_weight(own: Sum) -> f32 {
    return own.diffuse.weight + own.specular.weight;
}

fn cluster_lobe_length(alpha: f32, cosine: f32) -> f32 {
    let sharpness = 0.5 / ((alpha * alpha) * max(abs(cosine), 1e-4));
    if TOKSVIG {
        return vmf_mean_toksvig_2005(sharpness).length;
    }
    return vmf_mean_banerjee_2005(sharpness).length;
}

fn cluster_sharpness_of(mean: MeanLength) -> f32 {
    if TOKSVIG {
        return vmf_sharpness_toksvig_2005(mean);
    }
    return vmf_sharpness_banerjee_2005(mean);
}

struct Extent {
    variance: f32,
    covariance: array<f32, 6>,
}

fn cluster_extent_of(part: Part, axis: vec3<f32>) -> Extent {
    let scale = 1.0 / max(part.weight, F32_MIN_POSITIVE);
    let side = part.area * scale * (1.0 / 12.0);
    let flat_part = (vec3(1.0) - axis * axis) * side;
    let tilt = vec3(axis.x * axis.y, axis.x * axis.z, axis.y * axis.z) * side;
    let diagonal = part.position.diagonal * scale + flat_part;
    let rest = part.position.rest * scale - tilt;
    let trace = diagonal.x + diagonal.y + diagonal.z;
    return Extent(
        select(0.5 * trace, trace, TRACE),
        array(diagonal.x, diagonal.y, diagonal.z, rest.x, rest.y, rest.z),
    );
}

fn cluster_bulge_of(part: Part, mean_length: f32, variance: f32) -> f32 {
    let size = 2.0 * sqrt(variance);
    return max(min(part.bulge / max(part.weight * mean_length, F32_MIN_POSITIVE), size), -size);
}

fn cluster_stretched(light: SpecularVsgl, along: f32, tangent: vec4<f32>) -> SpecularVsgl {
    let ratio = along / max(tangent.w, F32_MIN_POSITIVE);
    let root = sqrt(max(min(ratio, 1e6), 1e-6));
    var made = light;
    made.alpha = min(light.alpha * root, 1.0);
    made.across = min(light.alpha / root, 1.0);
    made.turn = anisotropic_turn_of(light.axis, tangent.xyz);
    return made;
}

struct Lights {
    diffuse: DiffuseVsgl,
    specular: SpecularVsgl,
}

fn cluster_lights(sum: Sum, record: MapRecord) -> Lights {
    if SG {
        return cluster_lights_sg(sum, record);
    }
    return Lights(cluster_diffuse_cosine(sum, record), cluster_specular_cosine(sum, record));
}

fn cluster_to_light(record: MapRecord, position: vec3<f32>) -> vec3<f32> {
    return map_record_light(record, position);
}

fn cluster_diffuse_cosine(sum: Sum, record: MapRecord) -> DiffuseVsgl {
    let part = sum.diffuse;
    var made = DiffuseVsgl();
    made.axis = vec3(0.0, 0.0, 1.0);
    made.light = select(vec3(0.0, 0.0, 1.0), vec3(0.0), record.kind == MAP_EMITTERS);
    if part.weight > 0.0 {
        let facing = part_facing(part);
        let extent = cluster_extent_of(part, facing.axis);
        made.position = part.position.mean;
        made.variance = extent.variance;
        made.axis = facing.axis;
        made.sharpness = cluster_sharpness_of(facing.mean);
        made.intensity = sum.power * FRAC_1_PI;
        made.covariance = extent.covariance;
        made.light = cluster_to_light(record, part.position.mean);
        made.complement = facing.mean.complement;
        made.f0 = sum.dielectric.x / part.weight;
        made.f90 = sum.dielectric.y / part.weight;
        made.bulge = cluster_bulge_of(part, facing.mean.length, extent.variance);
    }
    return made;
}

fn cluster_specular_cosine(sum: Sum, record: MapRecord) -> SpecularVsgl {
    let part = sum.specular;
    var made = SpecularVsgl();
    made.axis = vec3(0.0, 0.0, 1.0);
    made.mirror = vec3(0.0, 0.0, 1.0);
    made.light = vec3(0.0, 0.0, 1.0);
    made.alpha = 1.0;
    if part.weight > 0.0 {
        let facing = part_facing(part);
        let mirror = cluster_facing(sum.mirror, part.weight);
        let lobe = mean_length_from_length(sqrt(dot(sum.lobe, sum.lobe)) / part.weight);
        let extent = cluster_extent_of(part, facing.axis);
        made.position = part.position.mean;
        made.variance = extent.variance;
        made.axis = facing.axis;
        made.complement = facing.mean.complement;
        made.mirror = mirror.axis;
        made.complement_mirror = mirror.mean.complement;
        made.light = cluster_to_light(record, part.position.mean);
        made.sharpness_lobe = cluster_sharpness_of(lobe);
        made.f0 = sum.f0;
        made.alpha = sqrt(sum.alpha2 / part.weight);
        made.f90 = sum.f90;
        made.bulge = cluster_bulge_of(part, facing.mean.length, extent.variance);
        made.covariance = extent.covariance;
    }
    return made;
}

fn cluster_lights_sg(sum: Sum, record: MapRecord) -> Lights {
    let both = part_merge(sum.diffuse, sum.specular);
    var place = both;
    var place_specular = both;
    if APART {
        place = sum.diffuse;
        place_specular = sum.specular;
    }

    var lambert_length = 0.0;
    if TOKSVIG {
        lambert_length = vmf_mean_toksvig_2005(COSINE_SHARPNESS_2015).length;
    } else {
        lambert_length = vmf_mean_banerjee_2005(COSINE_SHARPNESS).length;
    }
    let facing = part_facing(sum.diffuse);
    let mean = mean_length_from_length(facing.mean.length * lambert_length);
    let sharpness = cluster_sharpness_of(mean);
    var diffuse = DiffuseVsgl();
    diffuse.position = place.position.mean;
    diffuse.variance = cluster_extent_of(place, part_facing(place).axis).variance;
    diffuse.axis = facing.axis;
    diffuse.sharpness = sharpness;
    diffuse.intensity = sum.power / lobe_integral(sharpness);
    diffuse.light = cluster_to_light(record, diffuse.position);

    let weight = max(sum.specular.weight, F32_MIN_POSITIVE);
    let mean_lobe = mean_length_from_length(sqrt(dot(sum.lobe, sum.lobe)) / weight);
    let sharpness_lobe = cluster_sharpness_of(mean_lobe);
    var specular = SpecularVsgl();
    specular.position = place_specular.position.mean;
    specular.variance = cluster_extent_of(place_specular, part_facing(place_specular).axis).variance;
    specular.mirror = vec_normalize(sum.lobe);
    specular.sharpness_lobe = sharpness_lobe;
    specular.f0 = cluster_specular_power(sum) / lobe_integral(sharpness_lobe);
    specular.axis = part_facing(sum.specular).axis;
    specular.light = cluster_to_light(record, specular.position);
    specular.alpha = sqrt(sum.alpha2 / weight);
    return Lights(diffuse, specular);
}

fn cluster_specular_power(sum: Sum) -> vec3<f32> {
    let color = select(sum.f90, sum.f0, vec_luminance(sum.f0) > 0.0);
    return color * (sum.specular.weight / max(vec_luminance(color), F32_MIN_POSITIVE));
}

fn cluster_target(index: u32, count: u32, map_texels: u32) -> Target {
    let position = texel[index].xyz;
    let light = map_record_lit_side(map[index / map_texels], position, texel[count + index].xyz);
    var normal = vec3(0.0, 0.0, 1.0);
    if triangle[index] != NO_TRIANGLE {
        normal = surface_geometric_normal(triangle[index], light);
    }
    return Target(position, normal);
}
