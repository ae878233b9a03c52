//! Every function against tables of exact values.

use std::path::{Path, PathBuf};
use vsgl_cli::commands::lobe;
use vsgl_tests::assets::assets;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn judge(folder: &Path) -> Vec<String> {
    let judged = lobe::judge(folder).expect("tables are readable");
    assert!(!judged.is_empty(), "no table in {}", folder.display());
    let all = judged.iter().flat_map(|(_, errors)| errors);
    all.filter(|e| !e.holds())
        .map(|e| {
            format!(
                "{}: max {:e}, p99 {:e}, {} unfit",
                e.function,
                e.max(),
                e.percentile(0.99),
                e.unfit
            )
        })
        .collect()
}

#[test]
fn errors_are_as_stated() {
    assert_eq!(judge(&root().join("tests/reference")), Vec::<String>::new());
}

#[test]
fn errors_are_as_stated_on_further_tables() {
    if let Some(tables) = assets("reference", "further tables of exact values") {
        assert_eq!(judge(&tables), Vec::<String>::new());
    }
}

#[test]
fn accuracy_page_is_current() {
    let judged = lobe::judge(&root().join("tests/reference")).expect("tables are readable");
    let page =
        std::fs::read_to_string(root().join("docs/accuracy.md")).expect("docs/accuracy.md exists");
    assert!(
        page == lobe::markdown(&judged),
        "run: vsgl lobe --check tests/reference --markdown > docs/accuracy.md"
    );
}
