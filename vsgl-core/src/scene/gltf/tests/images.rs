use super::*;
use crate::scene::{Filter, Slot, TextureRef, Wrap};
use glam::{Affine2, Vec2};
use image::{ImageFormat, Rgba, RgbaImage};
use std::io::Cursor;

/// Two texels, red and half-transparent green.
fn png() -> Vec<u8> {
    image(ImageFormat::Png)
}

fn image(format: ImageFormat) -> Vec<u8> {
    let mut image = RgbaImage::new(2, 1);
    image.put_pixel(0, 0, Rgba([255, 0, 0, 255]));
    image.put_pixel(1, 0, Rgba([0, 255, 0, 128]));
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// The triangle with texture coordinates in accessor 2 and one material.
fn textured(material: &str) -> File {
    let mut file = File::triangle();
    file.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], "VEC2");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_1":2},"indices":1,"material":0}]}]"#;
    file.set("meshes", mesh)
        .set(
            "materials",
            &format!("[{{\"pbrMetallicRoughness\":{material}}}]"),
        )
        .set("textures", r#"[{"source":0},{"source":1,"sampler":0}]"#)
        .set("images", r#"[{"uri":"a.png"},{"uri":"a.png"}]"#)
}

const BASE: &str = r#"{"baseColorTexture":{"index":0,"texCoord":1}}"#;

#[test]
fn texels_and_coordinates_arrive() {
    let scene = textured(BASE).beside("a.png", &png()).load().unwrap();
    assert_eq!(scene.textures.len(), 1);
    let texture = &scene.textures[0];
    assert_eq!((texture.width, texture.height), (2, 1));
    assert_eq!(texture.texels, [[255, 0, 0, 255], [0, 255, 0, 128]]);
    assert_eq!(scene.mesh.texcoords, [Vec2::ZERO, Vec2::X, Vec2::Y]);
    assert_eq!(scene.materials[0].metallic_roughness_texture, None);
}

#[test]
fn samplers() {
    let scene = textured(r#"{"metallicRoughnessTexture":{"index":1,"texCoord":1}}"#)
        .set(
            "samplers",
            r#"[{"magFilter":9728,"wrapS":33071,"wrapT":33648}]"#,
        )
        .beside("a.png", &png())
        .load()
        .unwrap();
    let expected = TextureRef {
        texture: 0,
        wrap: [Wrap::Clamp, Wrap::Mirror],
        filter: Filter::Nearest,
        ..TextureRef::new(0)
    };
    assert_eq!(
        scene.materials[0].metallic_roughness_texture,
        Some(expected)
    );
    assert_eq!(scene.materials[0].base_color_texture, None);
}

#[test]
fn only_samplers_that_name_mip_maps_use_them() {
    for (filter, mips) in [(9728, false), (9729, false), (9984, true), (9987, true)] {
        let scene = textured(r#"{"metallicRoughnessTexture":{"index":1,"texCoord":1}}"#)
            .set("samplers", &format!(r#"[{{"minFilter":{filter}}}]"#))
            .beside("a.png", &png())
            .load()
            .unwrap();
        let texture = scene.materials[0].metallic_roughness_texture.unwrap();
        assert_eq!(texture.mips, mips, "{filter}");
    }
}

#[test]
fn images_in_the_buffer() {
    let mut file = textured(BASE);
    let view = file.view(&png());
    let images = format!(r#"[{{"bufferView":{view},"mimeType":"image/png"}},{{}}]"#);
    let scene = file.set("images", &images).load().unwrap();
    assert_eq!(scene.textures[0].texels.len(), 2);
}

/// The turn of Khronos' TextureTransformTest: its arrow must point at the mark for "correct".
#[test]
fn transforms_turn_the_right_way() {
    let mut file = textured(
        r#"{"baseColorTexture":{"index":0,"texCoord":7,"extensions":{"KHR_texture_transform":
        {"rotation":0.39269908169872414,"texCoord":1}}}}"#,
    );
    file.floats(&[[0.420952, 1.016267]; 3], "VEC2");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_1":3},"indices":1,"material":0}]}]"#;
    let scene = file
        .set("meshes", mesh)
        .set("extensionsRequired", r#"["KHR_texture_transform"]"#)
        .beside("a.png", &png())
        .load()
        .unwrap();
    let mapped = base_transform(&scene).transform_point2(scene.mesh.texcoords[0]);
    assert!(mapped.distance(Vec2::splat(0.7778175)) < 1e-5);
}

#[test]
fn transforms_scale_then_turn_then_move() {
    let scene = textured(
        r#"{"baseColorTexture":{"index":0,"texCoord":1,"extensions":{"KHR_texture_transform":
        {"offset":[0.25,0.5],"rotation":1.5707963267948966,"scale":[2,3]}}}}"#,
    )
    .beside("a.png", &png())
    .load()
    .unwrap();
    let expected = [
        Vec2::new(0.25, 0.5),
        Vec2::new(0.25, -1.5),
        Vec2::new(3.25, 0.5),
    ];
    assert_eq!(scene.mesh.texcoords, [Vec2::ZERO, Vec2::X, Vec2::Y]);
    for (&read, expected) in scene.mesh.texcoords.iter().zip(expected) {
        let mapped = base_transform(&scene).transform_point2(read);
        assert!(mapped.distance(expected) < 1e-6, "{mapped} {expected}");
    }
}

fn base_transform(scene: &Scene) -> Affine2 {
    scene.materials[0].base_color_texture.unwrap().transform
}

#[test]
fn transforms_beyond_numbers_are_refused() {
    for broken in [
        "\"scale\":[1e30,1]",
        "\"offset\":[0,-1e13]",
        "\"rotation\":1e20",
    ] {
        let material = format!(
            r#"{{"baseColorTexture":{{"index":0,"extensions":{{"KHR_texture_transform":{{{broken}}}}}}}}}"#
        );
        let place =
            "materials[0].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform";
        refused_at(place, textured(&material).beside("a.png", &png()));
    }
}

#[test]
fn a_material_reads_two_sets_and_says_so_of_a_third() {
    let mut file = textured(
        r#"{"baseColorTexture":{"index":0,"texCoord":1},"metallicRoughnessTexture":{"index":0,"texCoord":4}},
        "emissiveTexture":{"index":0,"texCoord":4},
        "normalTexture":{"index":0,"texCoord":2,"extensions":{"KHR_texture_transform":{"texCoord":1,"scale":[2,2]}}},
        "extensions":{"KHR_materials_specular":{"specularTexture":{"index":0,"texCoord":3}}"#,
    );
    file.floats(&[[0.5, 0.25]; 3], "VEC2");
    let mesh = r#"[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_1":2,"TEXCOORD_4":3},"indices":1,"material":0}]}]"#;
    let materials = file.json["materials"].replacen("}]", "}}]", 1);
    let scene = file
        .set("meshes", mesh)
        .set("materials", &materials)
        .beside("a.png", &png())
        .load()
        .unwrap();
    let material = &scene.materials[0];
    let sets = Slot::ALL.map(|slot| material.texture(slot).map(|texture| texture.set));
    assert_eq!(
        sets,
        [Some(0), Some(1), Some(0), Some(1), Some(0), None, None]
    );
    let scale = material.normal_texture.unwrap().transform.matrix2;
    assert_eq!(scale, glam::Mat2::from_diagonal(Vec2::splat(2.0)));
    assert_eq!(scene.mesh.texcoords, [Vec2::ZERO, Vec2::X, Vec2::Y]);
    assert_eq!(scene.mesh.texcoords_second, [Vec2::new(0.5, 0.25); 3]);
    assert!(scene.warnings.iter().any(|w| w.contains("a third")));
}

#[test]
fn missing_coordinates_are_said() {
    let scene = textured(r#"{"baseColorTexture":{"index":0}}"#)
        .beside("a.png", &png())
        .load()
        .unwrap();
    let warning = "textured surfaces without texture coordinates show one texel";
    assert_eq!(scene.warnings, [warning]);
    // The mesh has coordinates all the same: its material has a texture.
    assert_eq!(scene.mesh.texcoords, [Vec2::ZERO; 3]);
}

#[test]
fn textures_of_other_formats_are_left_out_with_a_warning() {
    let scene = textured(BASE)
        .set(
            "textures",
            r#"[{"extensions":{"KHR_texture_basisu":{"source":0}}}]"#,
        )
        .load()
        .unwrap();
    assert!(scene.textures.is_empty() && scene.mesh.texcoords.is_empty());
    assert_eq!(
        scene.warnings,
        ["textures without a PNG, JPEG or WebP image are left out"]
    );
}

#[test]
fn broken_images_are_refused_by_name() {
    refused_at("images[0].uri", textured(BASE));
    for bytes in [
        &b""[..],
        b"RIFF\0\0\0\0WEBPVP8 ",
        &png()[..20],
        &png()[..60],
        b"\xff\xd8\xff\xe0",
    ] {
        refused_at("images[0]", textured(BASE).beside("a.png", bytes));
    }
    let half = png().len() - 20;
    refused_at("images[0]", textured(BASE).beside("a.png", &png()[..half]));
    refused_at("images[0]", textured(BASE).set("images", "[{},{}]"));
}

#[test]
fn an_image_that_claims_to_be_huge_is_refused_unread() {
    let mut huge = png();
    // Width and height in the header, with its checksum.
    huge[16..24].copy_from_slice(&[0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff]);
    let crc = crc32(&huge[12..29]);
    huge[29..33].copy_from_slice(&crc.to_be_bytes());
    let (place, message) = refused(textured(BASE).beside("a.png", &huge).load());
    assert_eq!(place, "images[0]");
    assert!(message.contains("texels"), "{message}");
    let limits = Limits {
        texels: 1,
        ..Limits::default()
    };
    let (place, _) = refused(textured(BASE).beside("a.png", &png()).load_within(&limits));
    assert_eq!(place, "images[0]");
}

/// The checksum of PNG chunks.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| (crc >> 1) ^ (0xedb8_8320 & 0u32.wrapping_sub(crc & 1));
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| step(crc))
    })
}

#[test]
fn webp_as_it_is_and_by_its_extension() {
    let extension = r#"[{"extensions":{"EXT_texture_webp":{"source":1}}}]"#;
    for textures in [r#"[{"source":0}]"#, extension] {
        let scene = textured(BASE)
            .set("textures", textures)
            .set("images", r#"[{"uri":"a.webp"},{"uri":"a.webp"}]"#)
            .set("extensionsRequired", r#"["EXT_texture_webp"]"#)
            .beside("a.webp", &image(ImageFormat::WebP))
            .load()
            .unwrap();
        let texture = &scene.textures[0];
        assert_eq!((texture.width, texture.height), (2, 1));
        assert_eq!(texture.texels, [[255, 0, 0, 255], [0, 255, 0, 128]]);
        assert_eq!(scene.source.images[0].format, "WebP");
        assert_eq!(scene.source.images[0].name, "a.webp");
    }
    // Where both are there, the plain one is as good.
    let both = r#"[{"source":0,"extensions":{"EXT_texture_webp":{"source":9}}}]"#;
    let file = textured(BASE).set("textures", both);
    assert!(file.beside("a.png", &png()).load().is_ok());
    let missing = r#"[{"extensions":{"EXT_texture_webp":{"source":9}}}]"#;
    refused_at(
        "textures[0].source",
        textured(BASE).set("textures", missing),
    );
}

#[test]
fn broken_webp_is_refused() {
    let whole = image(ImageFormat::WebP);
    let mut refusals = 0;
    for length in 12..whole.len() {
        // The last bytes may hold nothing.
        match textured(BASE).beside("a.png", &whole[..length]).load() {
            Ok(scene) => assert_eq!(
                scene.textures[0].texels,
                [[255, 0, 0, 255], [0, 255, 0, 128]]
            ),
            refusal => {
                assert_eq!(refused(refusal).0, "images[0]");
                refusals += 1;
            }
        }
    }
    assert!(refusals > 20, "{refusals} of {}", whole.len());
    // The header promises 16384 texels a side.
    let mut large = whole.clone();
    let size = large.windows(4).position(|w| w == b"VP8L").unwrap() + 9;
    large[size..size + 4].copy_from_slice(&[0xff, 0xff, 0xff, 0x0f]);
    let limits = Limits {
        texels: 1 << 20,
        ..Limits::default()
    };
    let (_, message) = refused(textured(BASE).beside("a.png", &large).load_within(&limits));
    assert!(message.contains("texels"), "{message}");
}
