//! Every pipeline that a plan can ask for: valid for any WebGPU device, and in the languages of all of them.

use naga::back::{hlsl, msl, pipeline_constants, spv};
use naga::proc::Layouter;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, Module, ShaderStage};
use std::collections::{BTreeMap, BTreeSet};
use vsgl_core::plan::Plan;
use vsgl_core::scene::{SceneFacts, SurfaceFacts, samples};
use vsgl_core::settings::{
    Clustering, DiffuseForm, Emission, GlossyForm, Method, OcclusionMethod, Primary, Settings,
    SharpnessFit, Variance,
};
use vsgl_wgpu::{KernelId, MODULES, interop, kernels, link, wgpu};

/// Every plan: all choices of all settings, for scenes that have and lack what a plan asks about.
fn plans() -> Vec<Plan> {
    let scene = samples::by_name("cornell").expect("a sample");
    let sound = SceneFacts::new(&scene, &scene.lights, &scene.cameras[0].1);
    let mut facts = Vec::new();
    for bits in 0..16u32 {
        let has = |bit: u32| bits >> bit & 1 == 1;
        let mut fact = sound.clone();
        fact.glossy_receivers = has(0);
        fact.glossy_senders = has(1);
        fact.reflecting_senders = has(2);
        // Each by itself, beside all and none: what is read of surfaces is read apart.
        let some = SurfaceFacts {
            textures: has(3) != (bits % 5 == 0),
            normal_maps: has(3) != (bits % 5 == 1),
            colors: has(3) != (bits % 5 == 2),
            unlit: has(3) != (bits % 5 == 3),
            emission: has(3) != (bits % 5 == 4),
            anisotropy: has(3) != (bits % 3 == 0),
        };
        (fact.seen, fact.sent) = (some, some);
        fact.masks = bits % 3 == 0;
        facts.push(fact);
    }
    let mut plans = Vec::new();
    for settings in all_settings() {
        // Contradictions are refused, which other tests see to.
        plans.extend(
            facts
                .iter()
                .filter_map(|facts| Plan::new(facts, &settings).ok()),
        );
    }
    plans
}

fn all_settings() -> Vec<Settings> {
    let mut all = vec![Settings::default()];
    macro_rules! each {
        ($field:ident: $type:ty) => {
            all = all
                .iter()
                .flat_map(|s| {
                    <$type>::ALL.iter().map(move |&value| {
                        let mut s = s.clone();
                        s.$field = value;
                        s
                    })
                })
                .collect();
        };
    }
    each!(method: Method);
    each!(clustering: Clustering);
    each!(emission: Emission);
    each!(sharpness: SharpnessFit);
    each!(variance: Variance);
    each!(diffuse: DiffuseForm);
    each!(glossy: GlossyForm);
    each!(occlusion: OcclusionMethod);
    // Nothing else depends on it.
    all.push(Settings {
        primary: Primary::Raster,
        ..Settings::default()
    });
    all
}

/// The pipelines of all plans, each once, by file.
fn all_kernels() -> BTreeMap<&'static str, Vec<KernelId>> {
    let mut seen = BTreeSet::new();
    let mut by_file: BTreeMap<&str, Vec<KernelId>> = BTreeMap::new();
    let planned = plans().into_iter().flat_map(|plan| kernels(&plan));
    for id in planned.chain(interop::kernels()) {
        if seen.insert(format!("{id:?}")) {
            by_file.entry(id.file).or_default().push(id);
        }
    }
    by_file
}

fn validator() -> Validator {
    Validator::new(ValidationFlags::all(), Capabilities::empty())
}

fn parsed(file: &str) -> (Module, ModuleInfo) {
    let source = link(&[file]);
    let module = naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|e| panic!("{file}: {}", e.emit_to_string(&source)));
    let info = validator()
        .validate(&module)
        .unwrap_or_else(|e| panic!("{file}: {}", e.emit_to_string(&source)));
    (module, info)
}

#[test]
fn every_entry_with_every_set_of_constants_is_portable() {
    let all = all_kernels();
    let count: usize = all.values().map(Vec::len).sum();
    assert!(count > 100, "only {count} pipelines: the plans do not vary");
    for (file, ids) in &all {
        let (module, info) = parsed(file);
        for id in ids {
            let values = id
                .constants
                .iter()
                .map(|&(name, v)| (name.to_owned(), v))
                .collect();
            let stage = Some((ShaderStage::Compute, id.entry));
            let (resolved, info) =
                pipeline_constants::process_overrides(&module, &info, stage, &values)
                    .unwrap_or_else(|e| panic!("{id:?}: {e}"));
            let entry = (ShaderStage::Compute, id.entry.to_owned());
            write(&format!("{id:?}"), entry, &resolved, &info);
        }
    }
}

#[test]
fn what_is_drawn_is_portable() {
    let mut drawn = 0;
    for (file, _) in MODULES
        .iter()
        .filter(|(name, _)| name.starts_with("entry/"))
    {
        let (module, info) = parsed(file);
        for entry in &module.entry_points {
            if entry.stage != ShaderStage::Compute {
                let name = format!("{file}:{}", entry.name);
                write(&name, (entry.stage, entry.name.clone()), &module, &info);
                drawn += 1;
            }
        }
    }
    assert!(drawn >= 2, "{drawn} entries that draw");
}

/// Writes the languages of Vulkan, Direct3D and Metal.
fn write(id: &str, entry: (ShaderStage, String), module: &Module, info: &ModuleInfo) {
    let pipeline = spv::PipelineOptions {
        shader_stage: entry.0,
        entry_point: entry.1.clone(),
    };
    let options = spv::Options {
        fake_missing_bindings: true,
        ..spv::Options::default()
    };
    spv::write_vec(module, info, &options, Some(&pipeline))
        .unwrap_or_else(|e| panic!("{id}: SPIR-V: {e}"));
    let options = hlsl::Options {
        fake_missing_bindings: true,
        ..hlsl::Options::default()
    };
    let pipeline = hlsl::PipelineOptions {
        entry_point: Some(entry.clone()),
    };
    let mut text = String::new();
    hlsl::Writer::new(&mut text, &options, &pipeline)
        .write(module, info, None)
        .unwrap_or_else(|e| panic!("{id}: HLSL: {e}"));
    let options = msl::Options {
        fake_missing_bindings: true,
        lang_version: (2, 1),
        ..msl::Options::default()
    };
    let pipeline = msl::PipelineOptions {
        entry_point: Some(entry),
        ..msl::PipelineOptions::default()
    };
    msl::write_string(module, info, &options, &pipeline)
        .unwrap_or_else(|e| panic!("{id}: Metal: {e}"));
}

#[test]
fn every_entry_fits_the_least_limits() {
    let limits = wgpu::Limits::default();
    for (file, _) in MODULES
        .iter()
        .filter(|(name, _)| name.starts_with("entry/"))
    {
        let (module, info) = parsed(file);
        let mut layouter = Layouter::default();
        layouter.update(module.to_ctx()).expect("sizes are known");
        for (index, entry) in module.entry_points.iter().enumerate() {
            let used = info.get_entry_point(index);
            let name = format!("{file}:{}", entry.name);
            let (mut storage, mut workgroup) = (0, 0);
            for (handle, variable) in module.global_variables.iter() {
                if used[handle].is_empty() {
                    continue;
                }
                let size = layouter[variable.ty].size;
                match variable.space {
                    AddressSpace::Storage { .. } => storage += 1,
                    AddressSpace::WorkGroup => workgroup += size,
                    AddressSpace::Uniform => {
                        assert!(
                            u64::from(size) <= 256,
                            "{name}: a slot of parameters has 256 bytes"
                        );
                    }
                    _ => {}
                }
            }
            assert!(
                storage <= limits.max_storage_buffers_per_shader_stage,
                "{name}: {storage} buffers"
            );
            assert!(
                workgroup <= limits.max_compute_workgroup_storage_size,
                "{name}: {workgroup} bytes"
            );
            let invocations: u32 = entry.workgroup_size.iter().product();
            assert!(
                invocations <= limits.max_compute_invocations_per_workgroup,
                "{name}: {invocations} invocations"
            );
        }
    }
}

#[test]
fn every_file_is_linked_by_some_entry_and_names_what_it_needs() {
    let entries: Vec<&str> = MODULES
        .iter()
        .map(|(name, _)| *name)
        .filter(|name| name.starts_with("entry/"))
        .collect();
    let all = link(&entries.iter().map(|e| &**e).collect::<Vec<_>>());
    for (name, _) in MODULES {
        // The mathematics has functions that no phase uses yet; the table of functions sees to those.
        let mathematics = ["math/", "sg/", "brdf/"]
            .iter()
            .any(|d| name.starts_with(d));
        assert!(
            mathematics || all.contains(&format!("// {name}.wgsl\n")),
            "{name} is used nowhere"
        );
    }
}

#[test]
fn the_folder_holds_the_listed_files_and_no_other() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../vsgl-wgpu/shaders");
    let mut found = BTreeSet::new();
    for folder in std::fs::read_dir(&root).expect("the shaders") {
        let folder = folder.expect("a folder").path();
        for file in std::fs::read_dir(&folder).expect("a folder of shaders") {
            let path = file.expect("a file").path();
            let name = path.strip_prefix(&root).expect("inside").with_extension("");
            found.insert(name.to_string_lossy().replace('\\', "/"));
        }
    }
    let listed: BTreeSet<String> = MODULES.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(found, listed);
}
