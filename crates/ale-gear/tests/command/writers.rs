//! Every file that a command writes is there as a whole or as it was: on a full disk, where nobody may write, when the
//! process is stopped; and what is not this program's is never replaced.
#![cfg(unix)]

use std::{
    collections::BTreeMap,
    fs,
    os::unix::fs::symlink,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Duration,
};

use crate::util::{ISO_SCENE, Scratch, motion_scene, tiny_at_rest};

/// Every entry of a tree: links with what they say, files with what is in them.
fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let (mut open, mut all) = (vec![folder.to_owned()], BTreeMap::new());
    while let Some(at) = open.pop() {
        for entry in fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            let found = fs::symlink_metadata(&path).unwrap();
            let content = match () {
                () if found.is_symlink() => fs::read_link(&path).unwrap().into_os_string().into_encoded_bytes(),
                () if found.is_dir() => {
                    open.push(path.clone());
                    Vec::new()
                }
                () => fs::read(&path).unwrap(),
            };
            all.insert(path, content);
        }
    }
    all
}

const PLAN: &str = "scene = \"rest.toml\"\n[vary]\nkeys = [\"operation.torque_nm=100,150,200\"]\n\
                    output = [\"mean_ste_um\"]\n";
const STUDY: &str = "[[case]]\nscene = \"rest.toml\"\nvalue = 1\n[[case]]\nscene = \"iso.toml\"\nvalue = 2\n\
                     [[quantity]]\ncolumn = \"ste_um\"\n";

fn scratch() -> Scratch {
    Scratch::new()
        .file("iso.toml", ISO_SCENE)
        .file("rest.toml", tiny_at_rest(4))
        .file("motion.toml", motion_scene(4, "run = \"span\"\n"))
        .file("plan.toml", PLAN)
        .file("study.toml", STUDY)
        .file("page.md", "# A\n<!-- chart failure modes -->\nold\n<!-- end -->\n<!-- chart maps -->\n<!-- end -->\n")
}

/// Commands that write a result folder `o`, of every kind.
const FOLDERS: [&str; 9] = [
    "run iso.toml",
    "run rest.toml --no-cache",
    "run motion.toml --no-cache",
    "vary plan.toml --no-cache",
    "run study.toml --no-cache",
    "vary rest.toml --vary operation.torque_nm=50:100:2 --of ste_um --no-cache",
    "optimise rest.toml --evaluations 1 --no-cache",
    "envelope --only F1",
    "compare one one",
];

/// Commands that write the file of that name.
const FILES: [(&str, &str); 6] = [
    ("mesh generate rest.toml --gear pinion -o a.msh", "a.msh"),
    ("init new.toml --force", "new.toml"),
    ("geometry iso.toml --rexs pair.rexs", "pair.rexs"),
    ("report one", "one/report.html"),
    ("vary plan.toml --cases 0..2 --out part.csv --no-cache", "part.csv"),
    ("envelope --only F1 --out o --into page.md", "page.md"),
];

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

/// What makes a folder foreign, how it comes about, and the file that is then named.
type Foreign<'a> = (&'a str, &'a dyn Fn(&Path), &'a str);

/// A folder is a result by a summary of this program, and only files that it lists are replaced: all else, whatever its
/// names are, makes every command refuse before it does anything.
#[test]
fn only_files_of_a_result_are_replaced() {
    let scratch = scratch();
    let at = |name: &str| scratch.path().join(name);
    assert_eq!(scratch.command(&words("run iso.toml --out one")).code, Some(0));
    let own = fs::read_to_string(at("one/summary.json")).unwrap();
    let copy = |to: &Path| {
        fs::create_dir(to).unwrap();
        for (path, content) in tree(&at("one")) {
            fs::write(to.join(path.file_name().unwrap()), content).unwrap();
        }
    };
    let foreign: [Foreign; 8] = [
        ("names of results alone", &|o| fs::write(o.join("history.csv"), "years of work").unwrap(), "history.csv"),
        (
            "a folder of such a name",
            &|o| {
                fs::create_dir_all(o.join("flow.vtu/raw")).unwrap();
                fs::write(o.join("flow.vtu/raw/thesis.txt"), "years of work").unwrap();
            },
            "flow.vtu",
        ),
        (
            "a summary of another program",
            &|o| fs::write(o.join("summary.json"), own.replace("\"ale-gear\"", "\"other\"")).unwrap(),
            "summary.json",
        ),
        (
            "a file beside the result",
            &|o| {
                fs::remove_dir(o).unwrap();
                copy(o);
                fs::write(o.join("flow.vtu"), "another solver's").unwrap();
            },
            "flow.vtu",
        ),
        (
            "a folder in the place of a file",
            &|o| {
                fs::remove_dir(o).unwrap();
                copy(o);
                fs::remove_file(o.join("history.csv")).unwrap();
                fs::create_dir(o.join("history.csv")).unwrap();
                fs::write(o.join("history.csv/thesis.txt"), "years of work").unwrap();
            },
            "history.csv",
        ),
        (
            "a link in the place of a file",
            &|o| {
                fs::remove_dir(o).unwrap();
                copy(o);
                fs::remove_file(o.join("history.csv")).unwrap();
                symlink("../iso.toml", o.join("history.csv")).unwrap();
            },
            "history.csv",
        ),
        (
            "a folder of cases that are none",
            &|o| {
                fs::create_dir_all(o.join("cases/0")).unwrap();
                fs::write(o.join("cases/0/history.csv"), "years of work").unwrap();
                let summary = own.replace("\"files\": [", "\"files\": [\"cases\",");
                fs::write(o.join("summary.json"), summary).unwrap();
            },
            "cases/0/history.csv",
        ),
        (
            "a summary that is a link",
            &|o| symlink("../one/summary.json", o.join("summary.json")).unwrap(),
            "summary.json",
        ),
    ];
    for (what, make, named) in foreign {
        fs::create_dir(at("o")).unwrap();
        make(&at("o"));
        let before = tree(scratch.path());
        for line in FOLDERS {
            // Two that differ, or it would complain of that first.
            let line = line.replace("one one", "one ./one");
            let run = scratch.command(&[&words(&line)[..], &["--out", "o"]].concat());
            assert_eq!(run.code, Some(2), "{what}, {line}: {}", run.stderr);
            let said = format!("ale-gear: --out o: holds `{named}`, which is not a result file\nhint: ");
            assert!(run.stderr.starts_with(&said), "{what}, {line}: {}", run.stderr);
            assert!(tree(scratch.path()) == before, "{what}, {line}: something is another");
        }
        fs::remove_dir_all(at("o")).unwrap();
    }
}

/// A summary that somebody else has written may list what it likes: nothing outside of its folder is taken away, whatever
/// command finds it.
#[test]
fn a_forged_list_of_files_takes_nothing_away() {
    let scratch = scratch().file("thesis.tex", "years of work").file("fields.vtu", "another solver's");
    assert_eq!(scratch.command(&words("run iso.toml --out one")).code, Some(0));
    let absolute = scratch.path().join("thesis.tex").display().to_string();
    let list = [absolute.as_str(), "../thesis.tex", "../fields.vtu", "../one/../fields.vtu"];
    let forged = serde_json::json!({ "program": "ale-gear", "files": list }).to_string();
    for line in FOLDERS {
        fs::create_dir(scratch.path().join("o")).unwrap();
        fs::write(scratch.path().join("o/summary.json"), &forged).unwrap();
        let run = scratch.command(&[&words(line)[..], &["--out", "o", "-q"]].concat());
        assert_eq!(scratch.read("thesis.tex"), "years of work", "{line}");
        assert_eq!(scratch.read("fields.vtu"), "another solver's", "{line}: {}", run.stderr);
        fs::remove_dir_all(scratch.path().join("o")).unwrap();
    }
}

/// A file of another kind stays, the command's own input among them; one of the same kind is replaced.
#[test]
fn only_files_of_the_same_kind_are_replaced() {
    let scratch = scratch().file("thesis.tex", "years of work").file("empty.msh", "");
    assert_eq!(scratch.command(&words("run iso.toml --out one")).code, Some(0));
    assert_eq!(scratch.command(&words(FILES[0].0)).code, Some(0));
    assert_eq!(scratch.command(&words(FILES[2].0)).code, Some(0));
    let before = tree(scratch.path());
    for line in [
        "mesh generate rest.toml --gear pinion -o rest.toml",
        "mesh generate rest.toml --gear pinion -o thesis.tex",
        "mesh generate rest.toml --gear pinion -o pair.rexs",
        "geometry iso.toml --rexs iso.toml",
        "geometry iso.toml --rexs a.msh",
        "report one -o one/history.csv",
        "report one -o one/summary.json",
        "report one -o iso.toml",
        "vary plan.toml --cases 0..2 --out thesis.tex --no-cache",
    ] {
        let run = scratch.command(&words(line));
        assert_eq!(run.code, Some(2), "{line}: {}", run.stderr);
        assert!(run.stderr.contains(": exists and is not a ") && run.stderr.contains("\nhint: "), "{}", run.stderr);
        assert!(tree(scratch.path()) == before, "{line}: something is another");
    }
    for (line, _) in FILES {
        assert_eq!(scratch.command(&words(line)).code, Some(0), "{line}");
    }
    let empty = scratch.command(&words("mesh generate rest.toml --gear pinion -o empty.msh"));
    assert_eq!(empty.code, Some(0), "{}", empty.stderr);
}

/// What a command wrote it replaces, and so does any other.
#[test]
fn every_command_replaces_what_any_of_them_wrote() {
    let scratch = scratch();
    assert_eq!(scratch.command(&words("run iso.toml --out one")).code, Some(0));
    for line in FOLDERS.into_iter().chain(FOLDERS) {
        let run = scratch.command(&[&words(line)[..], &["--out", "o", "-q"]].concat());
        assert_eq!(run.code, Some(0), "{line}: {}", run.stderr);
        let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
        assert_eq!(summary["program"], "ale-gear", "{line}");
        let listed: Vec<&str> = summary["files"].as_array().unwrap().iter().filter_map(|f| f.as_str()).collect();
        let there = fs::read_dir(scratch.path().join("o")).unwrap();
        for name in there.map(|e| e.unwrap().file_name().into_string().unwrap()).filter(|n| n != "summary.json") {
            assert!(listed.contains(&name.as_str()), "{line}: {name} is not in its summary");
        }
    }
    let left = ["iso.toml", "motion.toml", "o", "one", "page.md", "plan.toml", "rest.toml", "study.toml"];
    assert_eq!(scratch.names(), left);
}

/// Files and folders beside a result that have names of this program's are not its own for that.
#[test]
fn what_stands_beside_a_result_is_not_taken_for_its_own() {
    let scratch = scratch().file("o.cases", "years of work").file("o.new", "mine").file("part.csv", "mine");
    fs::create_dir(scratch.path().join("s.cases")).unwrap();
    fs::write(scratch.path().join("s.cases/history.csv"), "mine").unwrap();
    fs::create_dir(scratch.path().join("m.checkpoint")).unwrap();
    fs::write(scratch.path().join("m.checkpoint/history.csv"), "mine").unwrap();
    let before = tree(scratch.path());
    for (line, said) in [
        ("vary plan.toml --out o", "--out o: o.cases holds no cases of this program\nhint: "),
        ("run study.toml --out s", "--out s: s.cases is not a folder of cases\nhint: "),
        ("run study.toml --out o", "--out o: o.cases is not a folder of cases\nhint: "),
        (
            "vary plan.toml --cases 0..2 --out part.csv",
            "--out part.csv: exists and is not a file of `ale-gear vary --cases`\n",
        ),
        ("run motion.toml --out m --stop-after-cycles 2", "m.checkpoint: is there, and was not made by this program"),
    ] {
        let run = scratch.command(&words(line));
        assert_eq!(run.code, Some(2), "{line}: {}", run.stderr);
        assert!(run.stderr.starts_with(&format!("ale-gear: {said}")), "{line}: {}", run.stderr);
        assert!(tree(scratch.path()) == before, "{line}: something is another");
    }
}

/// Where the disk is full every file is as it was, nothing is left, and with room the same command succeeds.
#[test]
fn a_full_disk_leaves_every_file_as_it_was() {
    let scratch = scratch();
    assert_eq!(scratch.command(&words("run iso.toml --out one")).code, Some(0));
    for (line, file) in FILES {
        assert_eq!(scratch.command(&words(line)).code, Some(0), "{line}");
        let path = scratch.path().join(file);
        // A part that is there is not made again.
        let mut content = fs::read(&path).unwrap();
        if file == "part.csv" {
            content = b"# cases of another plan\n".to_vec();
            fs::write(&path, &content).unwrap();
        }
        let _ = fs::remove_dir_all(scratch.path().join("o"));
        let before = tree(scratch.path());
        for kilobytes in [0, 1] {
            let script = format!("trap '' XFSZ; ulimit -f {}; exec ale-gear {line}", 2 * kilobytes);
            let run = scratch.shell(&script);
            if content.len() < 1000 && kilobytes == 1 {
                continue;
            }
            assert_eq!(run.code, Some(1), "{line}, {kilobytes} kB: {}", run.stderr);
            assert!(run.stderr.contains("cannot be written"), "{line}, {kilobytes} kB: {}", run.stderr);
            assert_eq!(run.stderr.matches("\nhint: ").count(), 1, "{line}, {kilobytes} kB: {}", run.stderr);
            assert!(tree(scratch.path()) == before, "{line}, {kilobytes} kB: something is another");
        }
        let run = scratch.command(&words(line));
        assert_eq!(run.code, Some(0), "{line} with room: {}", run.stderr);
        let _ = fs::remove_dir_all(scratch.path().join("o"));
    }
    // A new file of the user's: none, not an empty one.
    let run = scratch.shell("trap '' XFSZ; ulimit -f 0; exec ale-gear init another.toml");
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(!scratch.path().join("another.toml").exists());
    assert_eq!(scratch.command(&words("init another.toml")).code, Some(0));
}

/// All commands that write a folder leave it as it was, from nothing to nearly enough room.
#[test]
fn a_full_disk_leaves_every_folder_as_it_was() {
    let scratch = scratch();
    assert_eq!(scratch.command(&words("run iso.toml --out one")).code, Some(0));
    assert_eq!(scratch.command(&words("run iso.toml --out o")).code, Some(0));
    let of_cases = |name: &&PathBuf| !name.to_string_lossy().contains("o.cases");
    let before = tree(scratch.path());
    for line in FOLDERS {
        for kilobytes in [0, 2, 16] {
            let limit = 2 * kilobytes;
            let run = scratch.shell(&format!("trap '' XFSZ; ulimit -f {limit}; exec ale-gear {line} --out o -q"));
            if run.code == Some(0) {
                assert!(kilobytes > 0, "{line}");
                fs::remove_dir_all(scratch.path().join("o")).unwrap();
                assert_eq!(scratch.command(&words("run iso.toml --out o")).code, Some(0));
                continue;
            }
            assert_eq!(run.code, Some(1), "{line}, {kilobytes} kB: {}", run.stderr);
            let now = tree(scratch.path());
            // What is done of a study and of a plan stays beside, for the next run.
            let (now, before): (Vec<_>, Vec<_>) = (now.keys().filter(of_cases).collect(), before.keys().collect());
            assert_eq!(now, before, "{line}, {kilobytes} kB");
        }
        let run = scratch.command(&[&words(line)[..], &["--out", "o", "-q"]].concat());
        assert_eq!(run.code, Some(0), "{line} with room: {}", run.stderr);
        fs::remove_dir_all(scratch.path().join("o")).unwrap();
        assert_eq!(scratch.command(&words("run iso.toml --out o")).code, Some(0));
    }
    assert!(tree(scratch.path()).keys().eq(before.keys()));
}

/// Where nobody may write every command says so, once. (`/proc` refuses even the superuser.)
#[cfg(target_os = "linux")]
#[test]
fn a_place_where_nobody_may_write_is_named_by_all() {
    let scratch = scratch();
    assert_eq!(scratch.command(&words("run iso.toml --out one")).code, Some(0));
    let before = tree(scratch.path());
    let folders = FOLDERS.map(|line| format!("{line} --out /proc/o"));
    let files = FILES[..3].iter().map(|(line, file)| line.replace(file, "/proc/o"));
    for line in folders.into_iter().chain(files).chain(["report one -o /proc/o".to_owned()]) {
        let run = scratch.command(&words(&line));
        assert!(matches!(run.code, Some(1 | 2)), "{line}: {:?}: {}", run.code, run.stderr);
        assert!(run.stderr.starts_with("ale-gear: ") && run.stderr.contains("/proc/o"), "{line}: {}", run.stderr);
        assert_eq!(run.stderr.matches("\nhint: ").count(), 1, "{line}: {}", run.stderr);
        assert!(tree(scratch.path()) == before, "{line}");
    }
}

/// A write-protected file is not replaced by way of its name. The superuser may write everywhere.
#[test]
fn a_protected_file_stays() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = scratch().file("a.msh", "$MeshFormat\nmine");
    let file = scratch.path().join("a.msh");
    fs::set_permissions(&file, fs::Permissions::from_mode(0o444)).unwrap();
    if fs::File::options().write(true).open(&file).is_ok() {
        return;
    }
    let run = scratch.command(&words(FILES[0].0));
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert_eq!(scratch.read("a.msh"), "$MeshFormat\nmine");
}

/// Stopped by the system (`kill`, Slurm, systemd, docker) at any moment of any command: status 130, nothing half written
/// anywhere; a whole gear that METIS orders is on the way.
#[test]
fn a_command_that_is_stopped_leaves_nothing_half_written() {
    let mesher = "elements_profile = 6\nelements_thickness = 4\nelements_face = 8\nelements_rim = 3\n";
    let meshers = ["pinion", "wheel"].map(|gear| format!("[{gear}.mesher]\norder = 1\n{mesher}"));
    let general = ISO_SCENE.replace("model = \"iso\"", "model = \"reduced\"\nreduction = \"general\"");
    let scratch = scratch().file("general.toml", general + &meshers.concat());
    let lines = [
        "run general.toml --no-cache --out o",
        "mesh reduce general.toml --cache kept",
        "run study.toml --no-cache --out o",
        "vary general.toml --vary operation.torque_nm=10:400:400 --output mean_ste_um --no-cache --out o",
        "optimise general.toml --no-cache --out o",
        "chart rest.toml --out o",
        "envelope --out o",
    ];
    let names = scratch.names();
    let mut stopped = 0;
    for line in lines {
        for wait_ms in [20, 120, 400, 900] {
            let child =
                scratch.program().args(words(line)).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
            std::thread::sleep(Duration::from_millis(wait_ms));
            let kill = format!("kill -TERM {}", child.id());
            // It may have ended by itself.
            let _ = Command::new("sh").args(["-c", &kill]).stderr(Stdio::null()).status().unwrap();
            let ended = child.wait_with_output().unwrap();
            use std::os::unix::process::ExitStatusExt;
            // Before the handler is there nothing is, and the signal alone ends the program.
            let sound = matches!(ended.status.code(), Some(0 | 130)) || ended.status.signal() == Some(15);
            let said = String::from_utf8_lossy(&ended.stderr).into_owned();
            assert!(sound, "{line} after {wait_ms} ms: {}: {said}", ended.status);
            stopped += u32::from(ended.status.code() == Some(130));
            if ended.status.code() == Some(0) {
                let _ = fs::remove_dir_all(scratch.path().join("o"));
            }
            for kept in ["o.cases", "kept"] {
                let path = scratch.path().join(kept);
                let _ = fs::remove_dir_all(&path).or_else(|_| fs::remove_file(&path));
            }
            assert_eq!(scratch.names(), names, "{line} after {wait_ms} ms");
        }
    }
    assert!(stopped > 8, "only {stopped} runs were stopped in their work");
}

/// Two runs of a study or a plan into one folder at once: the second is told so, and takes nothing.
#[test]
fn a_second_run_into_a_folder_of_cases_is_told() {
    let scratch = scratch().file("o.cases", "");
    fs::create_dir(scratch.path().join("s.cases")).unwrap();
    fs::write(scratch.path().join("s.cases/.ale-gear-cases"), "").unwrap();
    let held = ["o.cases", "s.cases/.ale-gear-cases"].map(|name| {
        let file = fs::File::open(scratch.path().join(name)).unwrap();
        file.lock().unwrap();
        file
    });
    for (line, out) in [("vary plan.toml --out o", "o"), ("run study.toml --out s", "s")] {
        let run = scratch.command(&words(line));
        assert_eq!(run.code, Some(2), "{line}: {}", run.stderr);
        let said = format!(
            "ale-gear: --out {out}: another run into it is under way, its cases are in {out}.cases\nhint: wait"
        );
        assert!(run.stderr.starts_with(&said), "{line}: {}", run.stderr);
    }
    drop(held);
    for line in ["vary plan.toml --out o -q", "run study.toml --out s -q"] {
        assert_eq!(scratch.command(&words(line)).code, Some(0), "{line}");
    }
}

/// A result that is read back is a file with an end: not a pipe, not a device, not a terabyte of holes.
#[test]
fn results_are_read_from_files_with_an_end() {
    let scratch = scratch();
    let at = |name: &str| scratch.path().join(name);
    assert_eq!(scratch.command(&words("run rest.toml --out one --cache kept")).code, Some(0));
    let fifo = |name: &str| {
        let _ = fs::remove_file(at(name));
        assert!(Command::new("mkfifo").arg(at(name)).status().unwrap().success());
    };
    let copy = |to: &str| {
        fs::create_dir(at(to)).unwrap();
        for (path, content) in tree(&at("one")) {
            fs::write(at(to).join(path.file_name().unwrap()), content).unwrap();
        }
    };
    let no_file = "it is a device or a pipe, not a file";
    let refused = |line: &str, said: &str| {
        let run = scratch.command(&words(line));
        assert_eq!(run.code, Some(2), "{line}: {}", run.stderr);
        assert!(run.stderr.contains(said), "{line}: {}", run.stderr);
    };
    for (folder, file, line) in [
        ("a", "history.csv", "compare one a"),
        ("b", "summary.json", "compare one b"),
        ("c", "report.json.gz", "report c"),
    ] {
        copy(folder);
        fifo(&format!("{folder}/{file}"));
        refused(line, no_file);
        fs::remove_file(at(folder).join(file)).unwrap();
        symlink("/dev/zero", at(folder).join(file)).unwrap();
        refused(line, no_file);
        fs::remove_file(at(folder).join(file)).unwrap();
        fs::File::create(at(folder).join(file)).unwrap().set_len(1 << 42).unwrap();
        refused(line, "it is larger than ");
    }
    fifo("part.csv");
    refused("merge plan.toml part.csv --out m", no_file);
    fifo("page.md");
    refused("envelope --only F1 --out e --into page.md", no_file);
    // What the cache holds is made again.
    for entry in fs::read_dir(at("kept")).unwrap() {
        let path = entry.unwrap().path();
        fs::remove_file(&path).unwrap();
        symlink("/dev/zero", path).unwrap();
    }
    let run = scratch.command(&words("run rest.toml --out again --cache kept"));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.contains(no_file) && run.stdout.contains("the gear was reduced again"), "{}", run.stdout);
    assert!(scratch.read("one/history.csv") == scratch.read("again/history.csv"));
}
