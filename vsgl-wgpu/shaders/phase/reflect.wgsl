//! needs: phase/shade
// Sums over lights at one receiver. Twin of `vsgl-cpu/src/phase/block.rs`, one lane of it.

// Numbers of the forms, as `passes/shade.rs` gives them.
const EMISSION_COSINE: u32 = 0u;
const DIFFUSE_V13: u32 = 0u;
const DIFFUSE_V14: u32 = 1u;
const DIFFUSE_2024: u32 = 2u;
const DIFFUSE_2022: u32 = 3u;
const DIFFUSE_2018: u32 = 4u;
const DIFFUSE_SG_2015: u32 = 5u;
const DIFFUSE_SG_PRODUCT: u32 = 6u;
const GLOSSY_NDF_FILTER: u32 = 0u;
const GLOSSY_NDF_FILTER_2024: u32 = 1u;
const GLOSSY_ASG_2013: u32 = 2u;
const GLOSSY_ASG_2015: u32 = 3u;
const GLOSSY_SG: u32 = 4u;

// Sums without the receiver's colours.
struct Sums {
    diffuse: vec3<f32>,
    near: vec3<f32>,
    grazing: vec3<f32>,
}

fn sums_lit(sums: Sums) -> bool {
    let diffuse = sums.diffuse.x + sums.diffuse.y + sums.diffuse.z;
    let near = sums.near.x + sums.near.y + sums.near.z;
    let grazing = sums.grazing.x + sums.grazing.y + sums.grazing.z;
    return diffuse + (near + grazing) > 0.0;
}

fn sums_add(sum: Sums, more: Sums) -> Sums {
    return Sums(sum.diffuse + more.diffuse, sum.near + more.near, sum.grazing + more.grazing);
}

fn sums_scale(sums: Sums, share: f32) -> Sums {
    return Sums(sums.diffuse * share, sums.near * share, sums.grazing * share);
}

// What a receiver has in common for all lights: `two` where it has two roughnesses, else `one`; neither where nothing glossy
// is seen.
struct Surfaces {
    one: GlossyView,
    two: AnisotropicView,
}

fn surfaces_of(receiver: Receiver) -> Surfaces {
    var made: Surfaces;
    if ANISOTROPIC_RECEIVERS {
        made.two = shade_anisotropic_view(receiver);
    } else if GLOSSY_RECEIVERS {
        made.one = glossy_view_new(receiver.view, receiver.normal, receiver.alpha);
    }
    return made;
}

// Adds what a receiver reflects of a lobe.
fn reflect_lobe(sums: Sums, incoming: Incoming, receiver: Receiver, surfaces: Surfaces) -> Sums {
    var lambert = 0.0;
    if DIFFUSE == DIFFUSE_V13 {
        lambert = shade_lambert_v13(incoming, receiver);
    } else if DIFFUSE == DIFFUSE_V14 {
        lambert = shade_lambert_v14(incoming, receiver);
    } else if DIFFUSE == DIFFUSE_2024 {
        lambert = shade_lambert_2024(incoming, receiver);
    } else if DIFFUSE == DIFFUSE_2022 {
        lambert = shade_lambert_2022(incoming, receiver);
    } else if DIFFUSE == DIFFUSE_2018 {
        lambert = shade_lambert_2018(incoming, receiver);
    } else if DIFFUSE == DIFFUSE_SG_2015 {
        lambert = shade_lambert_sg_2015(incoming, receiver);
    } else if DIFFUSE == DIFFUSE_SG_PRODUCT {
        lambert = shade_lambert_sg_product(incoming, receiver);
    } else {
        lambert = shade_lambert_constant(incoming, receiver);
    }
    var specular = 0.0;
    if ANISOTROPIC_RECEIVERS {
        if GLOSSY == GLOSSY_NDF_FILTER {
            specular = shade_anisotropic_masked(incoming, surfaces.two);
        } else if GLOSSY == GLOSSY_NDF_FILTER_2024 {
            specular = shade_anisotropic_2024(incoming, surfaces.two);
        } else if GLOSSY == GLOSSY_ASG_2013 {
            specular = shade_anisotropic_asg_2013(incoming, receiver);
        } else if GLOSSY == GLOSSY_ASG_2015 {
            specular = shade_anisotropic_asg_2015(incoming, receiver);
        }
    } else if GLOSSY_RECEIVERS {
        if GLOSSY == GLOSSY_NDF_FILTER {
            specular = shade_glossy_masked(incoming, surfaces.one);
        } else if GLOSSY == GLOSSY_NDF_FILTER_2024 {
            specular = shade_glossy_2024(incoming, surfaces.one);
        } else if GLOSSY == GLOSSY_ASG_2013 {
            specular = shade_glossy_asg_2013(incoming, receiver);
        } else if GLOSSY == GLOSSY_ASG_2015 {
            specular = shade_glossy_asg_2015(incoming, receiver);
        } else if GLOSSY == GLOSSY_SG {
            specular = shade_glossy_sg(incoming, receiver);
        } else {
            specular = shade_glossy_blended(incoming, surfaces.one);
        }
    }
    return reflect_add(sums, incoming, receiver, lambert, specular);
}

// Adds what a receiver reflects of light from one direction.
fn reflect_point(sums: Sums, incoming: Incoming, receiver: Receiver) -> Sums {
    var specular = 0.0;
    if ANISOTROPIC_RECEIVERS {
        specular = shade_anisotropic_point(incoming, receiver);
    } else if GLOSSY_RECEIVERS {
        specular = shade_glossy_point(incoming, receiver);
    }
    return reflect_add(sums, incoming, receiver, shade_lambert_constant(incoming, receiver), specular);
}

fn reflect_add(sums: Sums, incoming: Incoming, receiver: Receiver, lambert: f32, specular: f32) -> Sums {
    var sum = sums;
    sum.diffuse += incoming.strength * lambert;
    if GLOSSY_RECEIVERS {
        let reflected = incoming.strength * specular;
        let grazing = reflected * shade_fresnel_weight(incoming, receiver);
        sum.near += reflected - grazing;
        sum.grazing += grazing;
    }
    return sum;
}

// What a receiver reflects of the Lambert part of a cluster.
fn reflect_diffuse(light: DiffuseVsgl, receiver: Receiver, surfaces: Surfaces) -> Sums {
    var incoming: Incoming;
    if EMISSION == EMISSION_COSINE {
        incoming = shade_incoming_diffuse(light, receiver.position, receiver.normal);
    } else {
        incoming = shade_incoming_sg(
            light.position, light.variance, light.axis, light.sharpness, light.intensity, receiver.position,
        );
    }
    return reflect_lobe(Sums(), incoming, receiver, surfaces);
}

// The same with its specular part added.
fn reflect_specular(sums: Sums, light: SpecularVsgl, receiver: Receiver, surfaces: Surfaces) -> Sums {
    var incoming: Incoming;
    if EMISSION == EMISSION_COSINE {
        if ANISOTROPIC_SENDERS {
            let sender = shade_anisotropic_sender_view(light);
            incoming = shade_incoming_anisotropic(light, sender, receiver.position, receiver.normal);
        } else {
            let sender = shade_sender_view(light);
            incoming = shade_incoming_specular(light, sender, receiver.position, receiver.normal);
        }
    } else {
        incoming = shade_incoming_sg(
            light.position, light.variance, light.mirror, light.sharpness_lobe, light.f0, receiver.position,
        );
    }
    return reflect_lobe(sums, incoming, receiver, surfaces);
}
