//! Rules that the tree keeps: layers point one way, and files stay about one idea.

use std::fs;
use std::path::{Path, PathBuf};

/// Each layer and the layers it may use. `monitor` is for all.
const LAYERS: &[(&str, &[&str])] = &[
    ("monitor", &[]),
    ("math", &[]),
    ("geometry", &["math"]),
    ("cutter", &["math"]),
    ("toolpath", &["math"]),
    ("import", &["math", "geometry"]),
    ("contact", &["math", "geometry", "cutter", "toolpath"]),
    ("posture", &["math", "geometry", "cutter", "toolpath", "contact"]),
    ("strategy", &["math", "geometry", "cutter", "toolpath", "contact", "posture"]),
    ("turning", &["math", "toolpath"]),
    ("verify", &["math", "geometry", "cutter", "toolpath"]),
    ("machine", &["math", "toolpath"]),
    ("post", &["math", "cutter", "toolpath", "machine"]),
    (
        "job",
        &[
            "math", "geometry", "cutter", "toolpath", "import", "contact", "posture", "strategy", "verify",
            "post", "turning", "machine",
        ],
    ),
    ("wasm", &["job", "toolpath"]),
    ("cli", &["job", "import", "cutter", "contact", "geometry", "toolpath"]),
];

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found.sort();
}

fn source() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&root, &mut files);
    files
        .into_iter()
        .map(|path| {
            let text = fs::read_to_string(&path).unwrap();
            (path.strip_prefix(&root).unwrap().to_path_buf(), text)
        })
        .collect()
}

fn layer(path: &Path) -> String {
    let first = path.components().next().unwrap().as_os_str().to_string_lossy().into_owned();
    first.trim_end_matches(".rs").to_string()
}

#[test]
fn layers_point_one_way() {
    let mut wrong = Vec::new();
    for (path, text) in source() {
        let layer = layer(&path);
        if layer == "lib" || layer == "main" {
            continue;
        }
        let allowed = LAYERS.iter().find(|(name, _)| *name == layer).map(|(_, allowed)| *allowed);
        let allowed = allowed.unwrap_or_else(|| panic!("{layer} is no layer: give it a row"));
        // A layer's own tests may look at what stands above it.
        let code = text.split("#[cfg(test)]").next().unwrap();
        for (i, line) in code.lines().enumerate() {
            let used = line.split("crate::").skip(1).filter_map(|rest| {
                rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().filter(|name| !name.is_empty())
            });
            for name in used {
                let known = LAYERS.iter().any(|(layer, _)| *layer == name);
                if known && name != layer && name != "monitor" && !allowed.contains(&name) {
                    wrong.push(format!("{}:{}: {layer} uses {name}", path.display(), i + 1));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn serde_stays_in_the_job() {
    // Import reads one JSON format by hand, through plain values.
    let allowed = ["job", "import"];
    for (path, text) in source() {
        let uses =
            text.lines().any(|l| l.trim_start().starts_with("use serde") || l.contains("derive(Serialize"));
        assert!(!uses || allowed.contains(&layer(&path).as_str()), "{} uses serde", path.display());
    }
}

#[test]
fn files_stay_about_one_idea() {
    for (path, text) in source() {
        let lines = text.lines().count();
        assert!(lines <= 600, "{} has {lines} lines: do two ideas live there?", path.display());
        assert!(text.starts_with("//!"), "{} does not say what it is", path.display());
    }
}
