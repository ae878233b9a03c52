//! Which backend computes: without an adapter, and with a software adapter.

use crate::run::{Folder, Ran, SMALL};
use serde_json::Value;
use vsgl_tests::gpu;

#[test]
fn without_an_adapter_wgpu_is_code_4_and_says_what_to_install() {
    let folder = Folder::new();
    for command in [
        format!("render -o a.png {SMALL} --backend wgpu"),
        format!("parity {SMALL}"),
    ] {
        let message = folder.run(&command).failed(4);
        for word in ["mesa-vulkan-drivers", "--backend cpu"] {
            assert!(message.contains(word), "{command}: no {word} in {message}");
        }
        assert!(folder.names().is_empty(), "{:?}", folder.names());
    }
}

#[test]
fn auto_takes_the_cpu_and_says_so_in_one_line() {
    let folder = Folder::new();
    let ran = folder.run(&format!("render -o auto.exr {SMALL}"));
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(ran.err.contains("CPU") && ran.err.contains("no GPU"));
    assert!(ran.ok().contains("on cpu"));
    folder
        .run(&format!("render -o cpu.exr {SMALL} --backend cpu"))
        .ok();
    assert!(folder.bytes("auto.exr") == folder.bytes("cpu.exr"));
    let document = folder.run(&format!("render -o a.exr {SMALL} --json --backend cpu"));
    assert!(document.json()["backend_reason"].is_null());
}

#[test]
fn a_list_without_adapters_says_so() {
    let folder = Folder::new();
    assert!(folder.run("info").ok().contains("no graphics driver"));
    assert_eq!(
        folder.run("info --json").json()["adapters"],
        Value::Array(Vec::new())
    );
}

/// The adapters that the program finds; none only where tests of the GPU are switched off.
pub(crate) fn adapters(folder: &Folder) -> Vec<Value> {
    let list = Ran::of(&mut folder.command_with_drivers("info --json")).json();
    let adapters = list["adapters"].as_array().expect("a list").clone();
    assert_eq!(adapters.is_empty(), !gpu::some("the program on adapters"));
    adapters
}

#[test]
fn adapters_are_listed_with_what_they_can_do() {
    let folder = Folder::new();
    for adapter in adapters(&folder) {
        assert!(adapter["name"].as_str().is_some_and(|n| !n.is_empty()));
        assert!(adapter["software"].is_boolean() && adapter["strict"].is_boolean());
        let limit = &adapter["limits"]["max_storage_buffers_per_shader_stage"];
        assert!(limit.as_u64().is_some_and(|n| n >= 8));
    }
}

#[test]
fn a_software_adapter_is_taken_only_by_name_and_named_as_one() {
    let folder = Folder::new();
    let all = adapters(&folder);
    let Some(software) = all.iter().find(|a| a["software"] == true) else {
        return;
    };
    let name = software["name"].as_str().expect("a name");
    let run = |flags: &str| {
        let mut command =
            folder.command_with_drivers(&format!("render -o a.exr {SMALL} --method vpl {flags}"));
        Ran::of(command.env("VSGL_ADAPTER", name))
    };
    let auto = run("--json").json();
    assert_eq!(auto["backend"], "cpu");
    let reason = auto["backend_reason"].as_str().expect("a reason");
    assert!(reason.contains("software adapter"), "{reason}");
    let chosen = run("--backend wgpu --json").json();
    assert_eq!(chosen["backend"], "wgpu");
    assert_eq!(chosen["adapter"]["software"], true);
    assert!(
        chosen["device"]
            .as_str()
            .is_some_and(|d| d.contains("software adapter"))
    );
    let report = run("--backend wgpu").ok();
    assert!(!report.contains("GPU time") && report.contains("a software adapter"));
}

#[test]
fn an_adapter_of_an_unknown_name_is_code_4() {
    let folder = Folder::new();
    let mut command =
        folder.command_with_drivers(&format!("render -o a.png {SMALL} --backend wgpu"));
    let message = Ran::of(command.env("VSGL_ADAPTER", "no such thing")).failed(4);
    assert!(message.contains("adapter"), "{message}");
}
