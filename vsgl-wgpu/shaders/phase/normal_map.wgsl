//! needs: data/words, math/vec, phase/footprint, phase/texture
// Normals from a normal map. Twin of `vsgl-core/src/phase/normal_map.rs`.
//
// Reads `corner`, which the entry binds.

// The normal that a material's map puts in the place of the unit normal `smooth_normal`, on the same side.
fn normal_map_mapped(material: MaterialRecord, place: Place, smooth_normal: vec3<f32>) -> vec3<f32> {
    let record = words_texture(material.normal_texture);
    let found = normal_map_tangent(record, place, smooth_normal);
    let tangent = found.xyz;
    if all(tangent == vec3(0.0)) {
        return smooth_normal;
    }
    let texel = texture_sample(material.normal_texture, place, false);
    let x = (2.0 * texel.x - 1.0) * material.normal_scale;
    let y = (2.0 * texel.y - 1.0) * material.normal_scale;
    let z = 2.0 * texel.z - 1.0;
    let bitangent = cross(smooth_normal, tangent) * found.w;
    return vec_normalize((tangent * x + bitangent * y) + smooth_normal * z);
}

// Unit tangent along increasing u of a texture, or zero; w: the sign of the bitangent.
fn normal_map_tangent(record: TextureRecord, place: Place, normal: vec3<f32>) -> vec4<f32> {
    let of_mesh = normal_map_tangent_of_mesh(place, normal);
    if any(of_mesh.xyz != vec3(0.0)) {
        return of_mesh;
    }
    let of_corner = corner[place.triangle];
    let first = vec3(of_corner[0], of_corner[1], of_corner[2]);
    let ab = vec3(of_corner[3], of_corner[4], of_corner[5]) - first;
    let ac = vec3(of_corner[6], of_corner[7], of_corner[8]) - first;
    let coordinates = texture_corners(record, place.triangle);
    let b = coordinates.b;
    let c = coordinates.c;
    let turned = b.x * c.y - b.y * c.x < 0.0;
    let forwards = vec_normalize(ab * c.y - ac * b.y);
    let along = select(forwards, -forwards, turned);
    let tangent = along - normal * dot(normal, along);
    let flipped = dot(cross(ab, ac), normal) < 0.0;
    let handed = select(1.0, -1.0, turned == flipped);
    let none = b.x * c.y == b.y * c.x || dot(tangent, tangent) <= TANGENT_MIN;
    return vec4(select(vec_normalize(tangent), vec3(0.0), none), handed);
}

// Unit tangent of the mesh, or zero; w: the sign of the bitangent.
fn normal_map_tangent_of_mesh(place: Place, normal: vec3<f32>) -> vec4<f32> {
    if columns.corner_tangent != NO_WORDS {
        let at = columns.corner_tangent + 12u * place.triangle;
        let a = words_vec3(at);
        let along = (a + (words_vec3(at + 4u) - a) * place.u) + (words_vec3(at + 8u) - a) * place.v;
        let tangent = along - normal * dot(normal, along);
        if dot(tangent, tangent) > TANGENT_MIN {
            return vec4(vec_normalize(tangent), select(1.0, -1.0, words_f32(at + 3u) < 0.0));
        }
    }
    return vec4(0.0, 0.0, 0.0, 1.0);
}

// A mapped normal that faces the viewer of a ray along `direction`.
fn normal_map_facing(normal: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    let away = vec_normalize(direction);
    let beyond = dot(normal, away) + HORIZON;
    if beyond > 0.0 {
        return vec_normalize(normal - away * beyond);
    }
    return normal;
}
