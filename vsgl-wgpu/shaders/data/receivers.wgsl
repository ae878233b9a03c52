//! needs: geom/traverse, phase/facing, phase/shade
// Samples of the G-buffer as receivers, and their shadow rays. Reads `receiver`, `grazing`, `triangle` and `params` with `eye`,
// `lift`, `count` and `nodes`, which the entry binds, and its constants GLOSSY_RECEIVERS and ANISOTROPIC_RECEIVERS.

// Place of the tangents among the columns.
const TANGENT: u32 = 4u;

fn receiver_at(i: u32) -> Receiver {
    let normal = receiver[params.count + i];
    let position = receiver[i].xyz;
    var alpha = 1.0;
    if GLOSSY_RECEIVERS {
        alpha = receiver[3u * params.count + i].w;
    }
    var tangent = vec4(0.0);
    if ANISOTROPIC_RECEIVERS {
        tangent = receiver[TANGENT * params.count + i];
    }
    return Receiver(
        position,
        normal.xyz,
        vec_normalize(params.eye - position),
        receiver[2u * params.count + i].w,
        normal.w,
        alpha,
        tangent.xyz,
        tangent.w,
    );
}

fn colors_at(i: u32) -> Colors {
    var f0 = vec3(0.0);
    var f90 = 0.0;
    if GLOSSY_RECEIVERS {
        f0 = receiver[3u * params.count + i].xyz;
        f90 = grazing[i];
    }
    return Colors(receiver[2u * params.count + i].xyz, f0, f90);
}

// Where shadow rays of a sample start.
fn origin_at(i: u32, position: vec3<f32>) -> vec3<f32> {
    let facing = surface_geometric_normal(triangle[i], params.eye - position);
    return position + facing * surface_lift(params.lift, position);
}

// Whether light reaches a sample from a point of a surface.
fn is_open(origin: vec3<f32>, position: vec3<f32>, normal: vec3<f32>) -> bool {
    let end = position + normal * surface_lift(params.lift, position);
    return !traverse_any_hit(params.nodes, ray_new(origin, end - origin), 1.0);
}
