//! What the shaders hold: no twin without a test, none missing, and nothing whose rounding a driver chooses.

use super::entries;
use std::collections::{BTreeMap, BTreeSet};
use vsgl_wgpu::wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
use vsgl_wgpu::wgpu::naga::{self, Expression, MathFunction, Module, Statement};
use vsgl_wgpu::{MODULES, link};

fn parse(source: &str) -> Module {
    naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)))
}

/// Whether a shader file holds mathematics, all of it to be in the table. Phases and geometry are compared as phases; what
/// is plain mathematics among them is in the table too.
fn is_mathematics(file: &str) -> bool {
    ["math/", "sg/", "brdf/"]
        .iter()
        .any(|folder| file.starts_with(folder))
}

fn called_in(block: &naga::Block, module: &Module, out: &mut BTreeSet<String>) {
    for statement in block {
        match statement {
            Statement::Call { function, .. } => {
                out.extend(module.functions[*function].name.clone());
            }
            Statement::Block(block) => called_in(block, module, out),
            Statement::If { accept, reject, .. } => {
                called_in(accept, module, out);
                called_in(reject, module, out);
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    called_in(&case.body, module, out);
                }
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                called_in(body, module, out);
                called_in(continuing, module, out);
            }
            _ => {}
        }
    }
}

/// The functions that a function calls.
fn called(function: &naga::Function, module: &Module) -> BTreeSet<String> {
    let mut out = BTreeSet::new();
    called_in(&function.body, module, &mut out);
    out
}

/// Functions of the mathematics in WGSL: name, file, what it calls.
fn functions() -> BTreeMap<String, (&'static str, BTreeSet<String>)> {
    let files: Vec<&str> = MODULES
        .iter()
        .map(|(name, _)| *name)
        .filter(|f| is_mathematics(f))
        .collect();
    let module = parse(&link(&files));
    let file_of = |function: &str| {
        let head = format!("fn {function}(");
        MODULES
            .iter()
            .find(|(_, text)| text.contains(&head))
            .map(|(file, _)| *file)
    };
    module
        .functions
        .iter()
        .filter_map(|(_, f)| {
            let name = f.name.clone()?;
            // Polynomials are made from core's tables and are in no file.
            Some((name.clone(), (file_of(&name)?, called(f, &module))))
        })
        .collect()
}

/// Functions in the table, and those that their calls reach.
fn tested() -> (BTreeSet<String>, BTreeSet<String>) {
    let all = functions();
    let mut direct = BTreeSet::new();
    for entry in entries() {
        let module = parse(&format!("{}{}", link(&[entry.file]), entry.shader()));
        let mut calls = called(&module.entry_points[0].function, &module);
        // What the entry adds to make the call.
        for (_, function) in module.functions.iter() {
            let name = function.name.as_deref().unwrap_or_default();
            if entry.text.contains(&format!("fn {name}(")) {
                calls.extend(called(function, &module));
            }
        }
        assert!(
            calls.contains(entry.name),
            "`{}` is not what its entry calls",
            entry.name
        );
        direct.extend(calls);
    }
    let mut reached = direct.clone();
    let mut open: Vec<String> = direct.iter().cloned().collect();
    while let Some(name) = open.pop() {
        for next in all.get(&name).map(|(_, calls)| calls).into_iter().flatten() {
            if reached.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    (direct, reached)
}

/// `GlossyView` → `glossy_view`.
fn snake(name: &str) -> String {
    let mut out = String::new();
    for (i, c) in name.char_indices() {
        if c.is_uppercase() && i > 0 {
            out.push('_');
        }
        out.extend(c.to_lowercase());
    }
    out
}

/// Functions of a file of core by the names of their twins, and whether each is public.
fn twins(file: &str) -> BTreeMap<String, bool> {
    let path = format!("{}/../vsgl-core/src/{file}.rs", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let module = file.rsplit('/').next().expect("a name");
    let mut owner = module.to_owned();
    let mut out = BTreeMap::new();
    for line in text
        .lines()
        .take_while(|line| !line.starts_with("mod tests"))
    {
        if let Some(kind) = line.strip_prefix("impl ") {
            let kind = kind.trim_end_matches([' ', '{']);
            // The shaders' phases have a surface of their own.
            owner = if file == "brdf/gltf" {
                format!("gltf_{}", snake(kind))
            } else {
                snake(kind)
            };
        } else if line == "}" {
            owner = module.to_owned();
        }
        let Some((before, after)) = line.split_once("fn ") else {
            continue;
        };
        let name = after.split(['(', '<']).next().unwrap_or_default();
        match before.trim() {
            "pub" => out.insert(format!("{owner}_{name}"), true),
            "" | "pub(super)" => out.insert(format!("{owner}_{name}"), false),
            _ => None,
        };
    }
    out
}

/// Helpers in WGSL that are not functions in core, or not alone, and functions of core that need no twin.
const ONLY_IN_WGSL: [&str; 1] = [
    // Of `axis_and_normal` the axis; the normal is +z.
    "cosine_axis",
];
const ONLY_IN_RUST: [&str; 2] = [
    "cosine_axis_and_normal",
    // For tests.
    "vec_tilted",
];

#[test]
fn every_function_has_a_twin_and_a_test() {
    let (direct, reached) = tested();
    let all = functions();
    let files: BTreeSet<&str> = MODULES
        .iter()
        .map(|(f, _)| *f)
        .filter(|f| is_mathematics(f))
        .collect();
    let mut wrong = Vec::new();
    let mut known = BTreeSet::new();
    for file in &files {
        for (name, public) in twins(file) {
            known.insert(name.clone());
            let name = name.as_str();
            if ONLY_IN_RUST.contains(&name) {
                continue;
            }
            match all.get(name) {
                None => wrong.push(format!("`{name}` of core has no twin in {file}.wgsl")),
                Some((at, _)) if at != file => {
                    wrong.push(format!("`{name}` is in {at}.wgsl, not {file}.wgsl"))
                }
                _ if public && !direct.contains(name) => {
                    wrong.push(format!("`{name}` is not in the table"));
                }
                _ => {}
            }
        }
    }
    for (name, (file, _)) in &all {
        if !known.contains(name) && !ONLY_IN_WGSL.contains(&name.as_str()) {
            wrong.push(format!("`{name}` in {file}.wgsl has no twin in core"));
        }
        if !reached.contains(name) {
            wrong.push(format!("`{name}` is not reached from the table"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(all.len() > 150, "only {} functions were found", all.len());
}

/// Plain functions of whole records, such as a map, a camera or the sums of a cluster, and of indices: every pixel, cluster
/// and round of the phases compares them.
const COMPARED_AS_PHASES: [&str; 63] = [
    "bsdf_density",
    "bsdf_evaluate",
    "bsdf_is_black",
    "bsdf_new",
    "bsdf_sample",
    "camera_map_sample",
    "camera_map_texel",
    "cluster_lights",
    "cluster_stretched",
    "direct_incoming",
    "direct_way",
    "draw_chance",
    "emit_point",
    "emit_texel",
    "facet_bounds",
    "facet_meet",
    "facet_new",
    "fill_before",
    "fill_pull",
    "fill_push",
    "fill_side",
    "footprint_step",
    "gbuffer_ray",
    "importance_density",
    "importance_first_light",
    "kernel_record",
    "map_frame_local",
    "map_frame_new",
    "map_frame_turn",
    "normal_map_facing",
    "occlusion_direction",
    "occlusion_open",
    "occlusion_place",
    "occlusion_probe",
    "path_camera_ray",
    "path_heuristic",
    "path_stream",
    "pdf_fibonacci",
    "pdf_level_count",
    "pdf_level_start",
    "pdf_top_level",
    "reconstruct_ahead",
    "rsm_ray",
    "run_is_apart",
    "run_of",
    "run_wide",
    "sampled_offset",
    "shares_count",
    "shares_sample",
    "shares_share",
    "splat_depth",
    "splat_draw",
    "splat_middle",
    "splat_new",
    "splat_number",
    "splat_piece",
    "splat_random_point",
    "splat_slot",
    "square_record",
    "sum_merge",
    "sum_scaled",
    "sum_weight",
    "texture_half",
];

/// Functions of phases and geometry that read nothing but their arguments: name and file.
fn plain() -> BTreeMap<String, &'static str> {
    let mut out = BTreeMap::new();
    for (file, _) in MODULES
        .iter()
        .filter(|(file, _)| file.starts_with("entry/"))
    {
        let module = parse(&link(&[file]));
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|e| panic!("{file}: {e}"));
        for (handle, function) in module.functions.iter() {
            let reads =
                |(global, _): (naga::Handle<naga::GlobalVariable>, &naga::GlobalVariable)| {
                    !info[handle][global].is_empty()
                };
            let name = function.name.clone().expect("a name");
            let head = format!("fn {name}(");
            let home = MODULES.iter().find(|(_, text)| text.contains(&head));
            let Some((home, _)) = home else { continue };
            let folder = home.starts_with("geom/") || home.starts_with("phase/");
            if folder && !module.global_variables.iter().any(reads) {
                out.insert(name, *home);
            }
        }
    }
    out
}

#[test]
fn plain_functions_of_phases_have_a_test() {
    let (direct, _) = tested();
    let mut wrong = Vec::new();
    let mut public = BTreeMap::new();
    for (name, file) in plain() {
        let all = public.entry(file).or_insert_with(|| {
            let path = format!("{}/../vsgl-core/src/{file}.rs", env!("CARGO_MANIFEST_DIR"));
            if std::path::Path::new(&path).exists() {
                twins(file)
            } else {
                BTreeMap::new()
            }
        });
        let compared = direct.contains(&name) || COMPARED_AS_PHASES.contains(&name.as_str());
        if all.get(&name) == Some(&true) && !compared {
            wrong.push(format!(
                "`{name}` in {file}.wgsl is neither in the table nor named as compared with its phase"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Files of core's mathematics that have twins at all.
#[test]
fn every_file_has_a_twin() {
    let files: BTreeSet<&str> = MODULES.iter().map(|(name, _)| *name).collect();
    // Tables and their evaluation become constants and chains; a fold of a list is what a workgroup does, and its order is
    // compared with the phases; `mod` lists.
    let none = ["math/coefficients", "math/polynomial", "math/fold"];
    let root = format!("{}/../vsgl-core/src", env!("CARGO_MANIFEST_DIR"));
    for folder in ["math", "sg", "brdf"] {
        for found in std::fs::read_dir(format!("{root}/{folder}")).expect("a folder of core") {
            let name = found
                .expect("a file")
                .file_name()
                .into_string()
                .expect("a plain name");
            let file = format!("{folder}/{}", name.trim_end_matches(".rs"));
            let listed = name == "mod.rs" || none.contains(&file.as_str());
            assert!(
                listed || files.contains(file.as_str()),
                "{file}.rs has no twin in WGSL"
            );
        }
    }
}

/// What every driver computes alike.
fn is_exact(function: MathFunction) -> bool {
    use MathFunction::*;
    matches!(
        function,
        Abs | Min
            | Max
            | Clamp
            | Saturate
            | Floor
            | Ceil
            | Trunc
            | Sqrt
            | Dot
            | Cross
            | CountOneBits
            | CountLeadingZeros
            | CountTrailingZeros
            | FirstLeadingBit
            | FirstTrailingBit
            | ReverseBits
            | ExtractBits
            | InsertBits
    )
}

/// The built-ins of a function that drivers round as they like.
fn inexact(function: &naga::Function) -> Vec<MathFunction> {
    let used = function
        .expressions
        .iter()
        .filter_map(|(_, expression)| match expression {
            Expression::Math { fun, .. } => Some(*fun),
            _ => None,
        });
    used.filter(|fun| !is_exact(*fun)).collect()
}

#[test]
fn no_shader_uses_a_builtin_that_drivers_round_as_they_like() {
    // Other files are parts of entries; that each is one of some entry is asserted where pipelines are listed.
    let whole = |file: &str| is_mathematics(file) || file.starts_with("entry/");
    for file in MODULES
        .iter()
        .map(|(file, _)| *file)
        .filter(|file| whole(file))
    {
        let module = parse(&link(&[file]));
        let entries = module.entry_points.iter().map(|e| (&e.name, &e.function));
        let named = module
            .functions
            .iter()
            .map(|(_, f)| (f.name.as_ref().expect("a name"), f));
        for (name, function) in named.chain(entries) {
            let found = inexact(function);
            assert!(found.is_empty(), "{file}.wgsl: `{name}` calls {found:?}");
        }
    }
}

#[test]
fn inexact_builtins_would_be_found() {
    for call in [
        "exp(x)",
        "mix(x, 1.0, 0.5)",
        "fma(x, x, x)",
        "sign(x)",
        "round(x)",
        "fract(x)",
        "pow(x, x)",
    ] {
        let module = parse(&format!("fn f(x: f32) -> f32 {{ return {call}; }}"));
        let (_, function) = module.functions.iter().next().expect("one function");
        assert_eq!(inexact(function).len(), 1, "{call}");
    }
}
