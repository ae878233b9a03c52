//! Each rule with its reason.

use vsgl_core::data::map_kind;
use vsgl_core::glam::Vec3;
use vsgl_core::plan::{Plan, SurfacePlan};
use vsgl_core::scene::{DirectionalLight, Light, Material, PointLight, SpotLight, TextureRef};
use vsgl_core::settings::{Emission, LightSampling, OcclusionMethod, Preset, Primary, Settings};
use vsgl_tests::render::Shot;

fn shot(settings: &str) -> Shot {
    Shot::sample("cornell").with(settings)
}

fn matte(mut shot: Shot) -> Shot {
    for material in &mut shot.scene.materials {
        *material = Material::lambert("matte", [0.5; 3]);
    }
    shot
}

/// The decision about a topic, and its reason.
fn reason<'a>(plan: &'a Plan, topic: &str) -> Option<(bool, &'a str)> {
    let found: Vec<_> = plan.reasons.iter().filter(|r| r.topic == topic).collect();
    assert!(found.len() <= 1, "`{topic}` is decided twice");
    found.first().map(|r| (r.runs, r.why.as_str()))
}

#[test]
fn everything_runs_where_everything_is_there() {
    let plan = shot("clustering=filtered").plan();
    let bounce = plan.bounce.as_ref().expect("a bounce");
    assert!(bounce.pdf.is_some() && bounce.cluster.is_some() && bounce.rsm.glossy);
    assert!(
        plan.shade.bounce
            && plan.shade.glossy_receivers
            && plan.shade.glossy_senders
            && plan.gbuffer.glossy
    );
    assert_eq!(plan.shade.occlusion, OcclusionMethod::Rays);
    for topic in [
        "bounce",
        "specular lobes of the lights",
        "specular term of the receivers",
        "pdf",
        "occlusion",
    ] {
        assert!(reason(&plan, topic).expect(topic).0, "{topic}");
    }
}

#[test]
fn no_bounce_without_triangles_lights_or_reflection() {
    let mut empty = shot("");
    empty.scene.mesh = Default::default();
    let mut dark = shot("");
    dark.lights.clear();
    let mut black = shot("");
    for material in &mut black.scene.materials {
        *material = Material::lambert("black", [0.0; 3]);
    }
    let mut away = shot("");
    for light in &mut away.lights {
        let Light::Spot(spot) = light else {
            panic!("a light of another kind")
        };
        spot.position = vsgl_core::glam::Vec3::Y * 50.0;
        spot.axis = vsgl_core::glam::Vec3::Y;
    }
    for (shot, why) in [
        (empty, "the scene has no triangles"),
        (dark, "the scene has no lights"),
        (
            black,
            "no surface that the lights may reach reflects anything",
        ),
        (
            away,
            "no surface that the lights may reach reflects anything",
        ),
    ] {
        let plan = shot.plan();
        assert_eq!(reason(&plan, "bounce"), Some((false, why)));
        assert!(plan.bounce.is_none() && !plan.shade.bounce && !plan.shade.glossy_senders);
        let frame = shot.frame();
        assert!(frame.rsm.is_none() && frame.pdf.is_none() && frame.vsgls.is_none());
        assert!(
            frame.radiance.indirect_diffuse.is_empty() && frame.radiance.indirect_glossy.is_empty()
        );
    }
}

#[test]
fn matte_scenes_have_no_specular_columns() {
    let shot = matte(shot(""));
    let plan = shot.plan();
    assert_eq!(
        reason(&plan, "specular lobes of the lights"),
        Some((false, "no glossy surface within reach of the lights"))
    );
    assert_eq!(
        reason(&plan, "specular term of the receivers"),
        Some((false, "no glossy surface in front of the camera"))
    );
    let frame = shot.frame();
    let (rsm, vsgls) = (frame.rsm.expect("maps"), frame.vsgls.expect("clusters"));
    assert!(rsm.specular.is_empty() && rsm.grazing.is_empty() && vsgls.specular.is_empty());
    assert!(frame.gbuffer.specular.is_empty() && frame.gbuffer.grazing.is_empty());
    assert!(
        frame.radiance.indirect_glossy.is_empty() && !frame.radiance.indirect_diffuse.is_empty()
    );
}

#[test]
fn many_maps_are_smaller_maps() {
    let point = Light::Point(PointLight {
        position: Vec3::Y,
        intensity: [1.0; 3],
        range: f32::INFINITY,
    });
    let sun = Light::Directional(DirectionalLight {
        axis: Vec3::NEG_Z,
        irradiance: [1.0; 3],
    });
    let side = |lights: &[Light], rsm: u32| {
        let mut shot = shot(&format!("rsm={rsm}"));
        shot.lights = lights.to_vec();
        let plan = shot.plan();
        let size = plan.bounce.as_ref().expect("a bounce").rsm.size;
        let (runs, why) = reason(&plan, "smaller maps").expect("a reason");
        assert_eq!(runs, size != rsm, "{why}");
        assert!(why.contains(&format!("{size}²")), "{why}");
        size
    };
    // One map is as large as wanted, and so are a few.
    assert_eq!(side(&[sun], 4096), 4096);
    assert_eq!(side(&[sun; 4], 512), 512);
    assert_eq!(side(&[sun; 5], 512), 256);
    // A point has six.
    assert_eq!(side(&[point], 256), 256);
    assert_eq!(side(&[point], 512), 256);
    assert_eq!(side(&[point; 5], 512), 128);
    assert_eq!(side(&[point; 5], 500), 125);
    assert_eq!(side(&vec![point; 50_000], 512), 1);
    let mut dark = shot("");
    dark.lights.clear();
    assert_eq!(reason(&dark.plan(), "smaller maps"), None);
}

#[test]
fn surfaces_that_shine_are_lights() {
    let mut shot = shot("rsm=512");
    assert_eq!(
        reason(&shot.plan(), "light of surfaces"),
        Some((false, "no surface shines"))
    );
    assert!(
        shot.frame()
            .rsm
            .expect("a map")
            .map
            .iter()
            .all(|m| m.kind == map_kind::CONE)
    );
    shot.scene.materials[0].emission = [1.0, 0.5, 0.0];
    let plan = shot.plan();
    assert!(reason(&plan, "light of surfaces").is_some_and(|(runs, _)| runs));
    assert!(plan.shade.emitters);
    let bounce = plan.bounce.as_ref().expect("a bounce");
    assert!(bounce.rsm.lights && bounce.rsm.emitters && bounce.rsm.size == 512);
    // Alone, they have as many texels as points.
    shot.lights.clear();
    let plan = shot.plan();
    assert_eq!(reason(&plan, "bounce"), Some((true, "surfaces shine")));
    let bounce = plan.bounce.as_ref().expect("a bounce");
    assert!(!bounce.rsm.lights && bounce.rsm.emitters && bounce.rsm.size == 256);
    let frame = shot.frame();
    assert_eq!(frame.rsm.expect("a map").map[0].kind, map_kind::EMITTERS);
    assert!(frame.vsgls.expect("clusters").count > 0);
    assert!(matte(shot).plan().bounce.is_none());
}

#[test]
fn a_cone_too_wide_for_one_map_takes_five() {
    let maps = |outer: f32| {
        let mut shot = shot("rsm=16");
        shot.spots().for_each(|s| s.outer = outer);
        let facts = shot.facts();
        assert_eq!(shot.frame().rsm.expect("maps").maps, facts.maps);
        facts.maps
    };
    assert_eq!(maps(SpotLight::ONE_MAP_MAX), 1);
    assert_eq!(maps(SpotLight::ONE_MAP_MAX + 1e-3), 5);
    assert_eq!(maps(SpotLight::OUTER_MAX), 5);
}

#[test]
fn surfaces_are_read_only_where_there_is_something() {
    let plain = shot("");
    let topics = [
        "texture reads",
        "normal maps",
        "vertex colours",
        "unlit surfaces",
        "emission",
        "alpha masks",
    ];
    for topic in topics {
        let plan = plain.plan();
        let (runs, why) = reason(&plan, topic).expect(topic);
        assert!(!runs && !why.is_empty(), "{topic}");
        assert_eq!(plan.gbuffer.surface, SurfacePlan::default());
        assert_eq!(
            plan.bounce.expect("a bounce").rsm.surface,
            plan.gbuffer.surface
        );
    }
    let mut textured = shot("");
    textured.scene.materials[0].base_color_texture = Some(TextureRef::new(0));
    let plan = textured.plan();
    assert_eq!(
        reason(&plan, "texture reads"),
        Some((
            true,
            "surfaces that are seen or reflect light have textures"
        ))
    );
    assert!(plan.gbuffer.surface.textures && plan.bounce.expect("a bounce").rsm.surface.textures);
    let whole = Shot::of(vsgl_tests::surfaces::everything(true, 4.0));
    let plan = whole.plan();
    for topic in topics {
        assert!(
            reason(&plan, topic).is_some_and(|(runs, _)| runs),
            "{topic}"
        );
    }
    let frame = whole.frame();
    assert_eq!(frame.gbuffer.emission.len(), frame.gbuffer.triangle.len());
    assert!(plain.frame().gbuffer.emission.is_empty());
}

#[test]
fn two_roughnesses_only_for_anisotropic_gloss() {
    let topics = [
        "two roughnesses of the receivers",
        "two roughnesses of the lights",
    ];
    let runs = |shot: &Shot| {
        let plan = shot.plan();
        let both = (
            plan.shade.anisotropic_receivers,
            plan.shade.anisotropic_senders,
        );
        let told = topics.map(|topic| reason(&plan, topic).is_some_and(|(runs, _)| runs));
        assert_eq!((told[0], told[1]), both);
        assert_eq!(plan.gbuffer.surface.anisotropy, both.0);
        assert_eq!(
            plan.bounce.expect("a bounce").rsm.surface.anisotropy,
            both.1
        );
        both
    };
    let stretched = |settings: &str| {
        let mut shot = shot(settings);
        for material in &mut shot.scene.materials {
            material.anisotropy = 0.5;
        }
        shot
    };
    assert_eq!(runs(&shot("")), (false, false));
    assert_eq!(runs(&stretched("")), (true, true));
    assert_eq!(runs(&matte(stretched(""))), (false, false));
    assert_eq!(runs(&stretched("emission=sg")), (true, false));
    assert_eq!(runs(&stretched("method=vpl emission=sg")), (true, true));
    let frame = stretched("").frame();
    assert_eq!(frame.gbuffer.tangent.len(), frame.gbuffer.triangle.len());
    assert!(shot("").frame().gbuffer.tangent.is_empty());
}

#[test]
fn a_rasteriser_leaves_masks_to_rays() {
    let masked = Shot::of(vsgl_tests::surfaces::everything(true, 4.0)).with("primary=raster");
    let plan = masked.plan();
    assert_eq!(plan.gbuffer.primary, Primary::Rays);
    assert!(reason(&plan, "raster").is_some_and(|(runs, why)| !runs && why.contains("masks")));
    // A mask that leaves out nothing is none.
    for (cutoff, alpha, masks) in [(0.0, 0.0, false), (0.5, 0.6, false), (0.5, 0.4, true)] {
        let mut plain = shot("");
        for material in &mut plain.scene.materials {
            (material.alpha_cutoff, material.alpha) = (Some(cutoff), alpha);
        }
        assert_eq!(plain.plan().shade.masks, masks, "{cutoff} {alpha}");
    }
}

#[test]
fn without_lights_only_the_camera_reads_surfaces() {
    let mut dark = Shot::of(vsgl_tests::surfaces::everything(true, 4.0));
    dark.lights.clear();
    let plan = dark.plan();
    let bounce = plan.bounce.as_ref().expect("light of surfaces");
    let surface = &bounce.rsm.surface;
    assert!(!bounce.rsm.lights && !surface.textures && !surface.normal_maps);
    assert!(plan.gbuffer.surface.emission);
    let image = dark.image();
    assert!(
        image.direct.iter().any(|rgb| rgb[0] > 0.0),
        "what shines is seen"
    );
}

#[test]
fn a_density_only_for_samples() {
    let plan = shot("clustering=partition").plan();
    assert_eq!(
        reason(&plan, "pdf"),
        Some((false, "an exact partition draws no samples"))
    );
    assert!(plan.bounce.expect("a bounce").pdf.is_none());
    assert!(shot("clustering=partition").frame().pdf.is_none());
    for clustering in [
        "filtered",
        "filtered-box",
        "filtered-original",
        "nearest-world",
    ] {
        let plan = shot(&format!("clustering={clustering} lights=77")).plan();
        assert_eq!(
            reason(&plan, "pdf"),
            Some((true, "cluster centres are drawn from a density")),
            "{clustering}"
        );
        let pdf = plan.bounce.expect("a bounce").pdf;
        let pdf = pdf.expect("a density");
        assert_eq!((pdf.count, pdf.importance), (77, None), "{clustering}");
    }
}

#[test]
fn importance_only_for_the_density_that_asks_what_is_seen() {
    for (settings, expected) in [
        ("clustering=partition pdf=brsm", None),
        ("method=vpl rsm=16 clustering=filtered pdf=brsm", None),
        (
            "clustering=filtered pdf=flux",
            Some((false, "the density asks only what the lights see")),
        ),
        (
            "clustering=filtered pdf=uniform",
            Some((false, "the density asks only what the lights see")),
        ),
        (
            "clustering=filtered pdf=brsm",
            Some((
                true,
                "virtual lights from what the camera sees say which texels matter to it",
            )),
        ),
    ] {
        let plan = shot(settings).plan();
        assert_eq!(reason(&plan, "importance"), expected, "{settings}");
        let bounce = plan.bounce.as_ref().expect("a bounce");
        let made = bounce.pdf.as_ref().and_then(|p| p.importance.as_ref());
        assert_eq!(made.is_some(), expected.is_some_and(|e| e.0), "{settings}");
    }
    // Senders and receivers change places, in the forms of the library whatever those of the settings are.
    let mut half = shot("clustering=filtered pdf=brsm camera_lights=99");
    half.settings = Settings {
        clustering: half.settings.clustering,
        pdf: half.settings.pdf,
        camera_lights: 99,
        ..Preset::Paper2016.settings()
    };
    let mut plan = half.plan();
    let pdf = plan.bounce.take().expect("a bounce").pdf;
    let made = pdf.and_then(|p| p.importance).expect("importance");
    assert_eq!(made.cluster.count, 99);
    assert_eq!(made.cluster.emission, Emission::Cosine);
    assert_eq!(made.cluster.glossy, plan.shade.glossy_receivers);
    assert_eq!(made.shade.glossy_receivers, plan.shade.glossy_senders);
    assert_eq!(made.shade.occlusion, OcclusionMethod::None);
}

#[test]
fn kernels_have_a_size_where_there_are_kernels() {
    for (clustering, expected) in [
        ("partition", None),
        (
            "filtered",
            Some((true, "each is as large as it must be to hold its share")),
        ),
        (
            "filtered-box",
            Some((true, "each is as large as it must be to hold its share")),
        ),
        (
            "filtered-original",
            Some((
                false,
                "a kernel's size follows from the density at its centre",
            )),
        ),
        (
            "nearest-world",
            Some((false, "every texel goes to the nearest centre")),
        ),
    ] {
        let plan = shot(&format!("clustering={clustering} kernel=2")).plan();
        assert_eq!(reason(&plan, "search for kernel sizes"), expected);
    }
}

#[test]
fn points_need_no_clusters() {
    let shot = shot("method=vpl rsm=16 occlusion=none clustering=filtered");
    let plan = shot.plan();
    assert_eq!(
        reason(&plan, "clusters"),
        Some((false, "the method `vpl` takes every texel for a light"))
    );
    let bounce = plan.bounce.as_ref().expect("a bounce");
    assert!(bounce.cluster.is_none() && bounce.pdf.is_none());
    let frame = shot.frame();
    assert!(frame.rsm.is_some() && frame.vsgls.is_none() && frame.pdf.is_none());
}

#[test]
fn occlusion_is_said_to_be_off() {
    let plan = shot("occlusion=none").plan();
    assert_eq!(
        reason(&plan, "occlusion"),
        Some((false, "switched off: indirect light passes through walls"))
    );
    assert_eq!(plan.shade.occlusion, OcclusionMethod::None);
    // Without a bounce there is nothing to block, and nothing is said.
    let mut dark = shot("");
    dark.lights.clear();
    assert_eq!(reason(&dark.plan(), "occlusion"), None);
    assert_eq!(dark.plan().shade.occlusion, OcclusionMethod::None);
}

#[test]
fn whole_maps_need_neither_density_nor_number() {
    for (name, lights, maps) in [("cornell", 1, 1), ("many-lights:3", 65_536, 3)] {
        let whole = Shot::sample(name).with(&format!("clustering=whole lights={lights}"));
        let plan = whole.plan();
        assert_eq!(
            reason(&plan, "number of lights"),
            Some((
                false,
                "each map is one cluster, however many lights are asked for"
            ))
        );
        assert_eq!(
            reason(&plan, "pdf"),
            Some((false, "whole maps are not sampled"))
        );
        let bounce = plan.bounce.as_ref().expect("a bounce");
        let cluster = bounce.cluster.as_ref().expect("clusters");
        assert!(bounce.pdf.is_none() && cluster.apart);
        assert_eq!(cluster.count, maps);
        let frame = whole.frame();
        let vsgls = frame.vsgls.expect("clusters");
        assert_eq!(vsgls.count, maps);
        assert!(vsgls.label.is_empty() && vsgls.kernel.is_empty());
    }
    assert_eq!(reason(&shot("").plan(), "number of lights"), None);
}

#[test]
fn forms_of_one_roughness_read_no_second() {
    for (form, two) in [
        ("ndf-filter", true),
        ("asg-2015", true),
        ("sg", false),
        ("blend", false),
    ] {
        let mut shot = shot(&format!("glossy={form}"));
        for material in &mut shot.scene.materials {
            material.anisotropy = 0.5;
        }
        let plan = shot.plan();
        let (runs, why) = reason(&plan, "two roughnesses of the receivers").expect(form);
        assert_eq!((runs, plan.shade.anisotropic_receivers), (two, two));
        assert!(two || why.contains("one roughness"), "{form}: {why}");
        assert_eq!(plan.gbuffer.surface.anisotropy, two);
        assert!(plan.shade.anisotropic_senders, "senders are not the form's");
        let points = shot.with("method=vpl").plan();
        assert!(points.shade.anisotropic_receivers, "points use no form");
    }
}

#[test]
fn raster_is_a_choice_with_a_reason() {
    let (rays, raster) = (shot("").plan(), shot("primary=raster").plan());
    assert!(reason(&rays, "raster").is_some_and(|(runs, why)| !runs && why.contains("rays")));
    assert!(reason(&raster, "raster").is_some_and(|(runs, why)| runs && why.contains("edges")));
    assert_ne!(rays.gbuffer, raster.gbuffer);
}

#[test]
fn paths_need_no_lights_made_of_texels() {
    let plan = matte(shot("method=path spp=3 max_depth=2")).plan();
    assert!(plan.bounce.is_none() && !plan.shade.bounce);
    let path = plan.path.as_ref().expect("paths");
    assert_eq!((path.samples, path.max_depth), (3, 2));
    assert!(!path.glossy && !path.emitters && !path.surface.emission && !path.surface.textures);
    assert_eq!(
        reason(&plan, "specular parts"),
        Some((false, "no surface is glossy"))
    );
    assert_eq!(
        reason(&plan, "light of surfaces"),
        Some((false, "no surface shines"))
    );
    let mut shining = shot("method=path");
    shining.scene.materials[0].emission = [1.0; 3];
    let plan = shining.plan();
    let path = plan.path.as_ref().expect("paths");
    assert!(path.glossy && path.emitters && path.surface.emission);
    // What the camera sees is not asked for what it sends: paths find that.
    assert!(!plan.gbuffer.surface.emission);
    let plan = shining.with("max_depth=1").plan();
    assert_eq!(
        reason(&plan, "light of surfaces"),
        Some((false, "paths of depth 1 end at the first surface"))
    );
    assert!(shot("").plan().path.is_none());
}

#[test]
fn lights_are_drawn_by_power_where_there_are_several() {
    let one = shot("method=path");
    let topic = "lights by power";
    assert_eq!(
        reason(&one.plan(), topic),
        Some((false, "there is one light alone"))
    );
    let mut two = one.clone();
    two.lights.push(two.lights[0]);
    assert_eq!(reason(&two.plan(), topic).map(|r| r.0), Some(true));
    let even = two.with("light_sampling=uniform").plan();
    assert_eq!(
        reason(&even, topic),
        Some((false, "each is drawn with the same chance, as asked"))
    );
    let path = even.path.expect("paths");
    assert_eq!(path.light_sampling, LightSampling::Uniform);
    let mut dark = one;
    dark.lights.clear();
    assert_eq!(
        reason(&dark.plan(), topic),
        Some((false, "there is no light"))
    );
}

#[test]
fn what_paths_do_not_need_is_said() {
    for (words, topic) in [
        ("interleave=4", "interleaved shading"),
        ("occlusion=ism", "shadow maps"),
        ("occlusion=sampled", "sampled occlusion"),
        ("occlusion=none", "light through walls"),
        ("primary=raster", "raster"),
    ] {
        let plain = shot("method=path").plan();
        assert_eq!(reason(&plain, topic), None, "{topic}");
        let plan = shot(&format!("method=path {words}")).plan();
        let (runs, why) = reason(&plan, topic).expect(topic);
        assert!(!runs && why.contains("method `path`"), "{topic}: {why}");
        // Nothing else is different.
        assert_eq!(plan.path, plain.path, "{topic}");
        assert_eq!(plan.gbuffer, plain.gbuffer, "{topic}");
    }
}

#[test]
fn shadow_maps_only_where_they_are_asked_for() {
    let plan = shot("").plan();
    let rays = Some((false, "rays say what blocks indirect light"));
    assert_eq!(reason(&plan, "shadow maps"), rays);
    assert!(plan.bounce.expect("light").occlusion.is_none());
    for (words, tessellated) in [
        ("occlusion=ism", false),
        ("occlusion=ism-tessellated", true),
    ] {
        let few = shot(words).with("lights=16 map_size=32 map_points=100");
        let maps = few.plan().bounce.expect("light").occlusion.expect(words);
        assert_eq!(
            (maps.side, maps.points, maps.tessellated, maps.masks),
            (32, 100, tessellated, false)
        );
        assert_eq!(
            reason(&few.plan(), "smaller shadow maps").map(|r| r.0),
            Some(false)
        );
        // As many maps as there may be lights, of as many texels as there may be in all.
        let many = few.with("lights=65536 map_size=256 map_points=8192");
        let maps = many.plan().bounce.expect("light").occlusion.expect(words);
        assert_eq!((maps.side, maps.points), (16, 1024));
        assert_eq!(
            reason(&many.plan(), "smaller shadow maps").map(|r| r.0),
            Some(true)
        );
        let mut dark = shot(words);
        dark.lights.clear();
        assert!(dark.plan().bounce.is_none());
    }
}
