//! `stepover post` on the command line.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const MACHINES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/machines/");

const APT: &str = "PARTNO/groove\nUNITS/MM\nCUTTER/8,2\nLOADTL/3\nSPINDL/9000,CLW\n\
    PPRINT/LINK\nRAPID\nGOTO/0,0,60,0,0,1\nFEDRAT/300,MMPM\nGOTO/0,0,0,0,0,1\n\
    PPRINT/PASS 1\nFEDRAT/1200,MMPM\nGOTO/10,0,0,0.1736482,0,0.9848078\nGOTO/20,0,0,0.1736482,0,0.9848078\n\
    PPRINT/LINK\nRAPID\nGOTO/20,0,60,0.1736482,0,0.9848078\nFINI\n";

/// A folder of its own for a test, with the cutter locations in it.
fn folder(test: &str, apt: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("path.apt"), apt).unwrap();
    folder
}

fn post(folder: &Path, machine: &str, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stepover"))
        .current_dir(folder)
        .args(["post", "path.apt", "--machine", &format!("{MACHINES}{machine}.json")])
        .args(more)
        .output()
        .unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_program_is_written_and_what_it_reads_back_as_too() {
    let folder = folder("post_written", APT);
    let more = ["--dialect", "linuxcnc", "--out", "path.ngc", "--read-back", "back.apt"];
    let output = post(&folder, "table_table_bc", &more);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(names(&folder), ["back.apt", "path.apt", "path.ngc"]);
    let said = String::from_utf8(output.stdout).unwrap();
    for word in ["blocks", "time", "read back", "B            "] {
        assert!(said.contains(word), "{word} in\n{said}");
    }
    let back = fs::read_to_string(folder.join("back.apt")).unwrap();
    assert!(back.contains("GOTO/20.0000") && back.contains("PPRINT/PASS 1"), "{back}");
}

#[test]
fn without_a_file_the_program_is_printed() {
    let folder = folder("post_printed", APT);
    let output = post(&folder, "head_head_ac", &["--dialect", "heidenhain"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(
        said.starts_with("0 BEGIN PGM groove MM\n") && said.trim_end().ends_with("END PGM groove MM"),
        "{said}"
    );
}

#[test]
fn whatever_goes_wrong_leaves_what_was_there() {
    let tilted = APT.replace("0.1736482,0,0.9848078", "0.9848078,0,0.1736482");
    let cases = [
        (
            APT.replace("GOTO/0,0,0,", "CIRCLE/0,0,0,"),
            "head_head_ab",
            "linuxcnc",
            1,
            "path.apt: line 10: CIRCLE",
        ),
        (tilted, "head_head_ab", "linuxcnc", 1, "B would go to 80.000°"),
        (APT.into(), "three_axis", "grbl", 1, "without rotary axes"),
        (APT.into(), "head_head_ab", "fidia", 2, "must be one of linuxcnc, fanuc"),
        (APT.into(), "none", "linuxcnc", 2, "none.json"),
    ];
    for (apt, machine, dialect, code, why) in cases {
        let folder = folder("post_refused", &apt);
        fs::write(folder.join("path.ngc"), "as before").unwrap();
        let output = post(&folder, machine, &["--dialect", dialect, "--out", "path.ngc"]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(code) && said.contains(why), "{why}: {said}");
        assert_eq!(fs::read_to_string(folder.join("path.ngc")).unwrap(), "as before");
        assert_eq!(names(&folder), ["path.apt", "path.ngc"]);
    }
    // A folder in the way: the program cannot take its place, and nothing is left beside it.
    let folder = folder("post_in_the_way", APT);
    fs::create_dir(folder.join("path.ngc")).unwrap();
    let output = post(&folder, "head_head_ab", &["--dialect", "linuxcnc", "--out", "path.ngc"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(names(&folder), ["path.apt", "path.ngc"]);
}
