//! `./x setup --full` fetches what `tools/lock.tsv` pins, refuses what is not that, says what came in its place, and names what it
//! could not have. Run with stand-ins for the clients of package sources, on a path that has nothing else of the kind.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Programs that the scripts need besides bash and Debian's.
const PLAIN: [&str; 20] = [
    "bash",
    "dirname",
    "awk",
    "cut",
    "env",
    "find",
    "mktemp",
    "mkdir",
    "rm",
    "mv",
    "cat",
    "id",
    "grep",
    "tar",
    "sha256sum",
    "printf",
    "ln",
    "cp",
    "gzip",
    "chmod",
];

/// What `dxc` is built of.
const DXC_PROGRAM: &str = "crates/translate/tools/dxc.cpp";

/// What `dawn` is.
const DAWN_PROGRAM: &str = "crates/translate/tools/dawn.cjs";

/// A copy of the scripts with a lock of their own, a cache, and a path.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let place = Self { folder };
        for folder in [
            "bin",
            "tools",
            "pool/usr/lib/chromium",
            "pool/usr/share/doc/chromium-common",
        ] {
            fs::create_dir_all(place.path(folder)).unwrap();
        }
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        for script in ["x", "tools/full.sh", DXC_PROGRAM, DAWN_PROGRAM] {
            fs::create_dir_all(place.path(script).parent().unwrap()).unwrap();
            fs::copy(root.join(script), place.path(script)).unwrap();
        }
        for program in PLAIN {
            let found = std::env::split_paths(&std::env::var_os("PATH").unwrap())
                .map(|folder| folder.join(program))
                .find(|path| path.is_file());
            std::os::unix::fs::symlink(found.unwrap(), place.path("bin").join(program)).unwrap();
        }
        // What `setup` without --full looks for counts as there.
        for checker in ["spirv-val", "glslangValidator", "chromium", "c++", "clang"] {
            place.program(checker, "exit 0");
        }
        place
    }

    fn path(&self, below: &str) -> PathBuf {
        self.folder.path().join(below)
    }

    fn program(&self, name: &str, body: &str) {
        let path = self.path("bin").join(name);
        fs::write(&path, format!("#!/usr/bin/env bash\n{body}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }

    /// A Debian that offers one version of the package: a tar archive of the folder `pool`.
    fn with_debian(self, offered: &str) -> Self {
        for (file, content) in [
            ("pool/usr/lib/chromium/libvk_swiftshader.so", "the driver"),
            ("pool/usr/lib/chromium/vk_swiftshader_icd.json", "{}"),
            ("pool/usr/share/doc/chromium-common/copyright", "its terms"),
        ] {
            fs::write(self.path(file), content).unwrap();
        }
        let (archive, pool) = (self.path("package.deb"), self.path("pool"));
        let pack = ["--sort=name", "--mtime=@0", "--owner=0", "--group=0"];
        let made = Command::new("tar")
            .args(pack)
            .arg("-C")
            .arg(&pool)
            .arg("-cf")
            .arg(&archive)
            .arg(".")
            .status();
        assert!(made.unwrap().success());
        let archive = archive.display();
        self.program("dpkg", "echo here");
        self.program("apt-cache", "exit 0");
        self.program(
            "apt-get",
            &format!(
                "[ \"$1\" = update ] && exit 0\ncase \"${{@: -1}}\" in\n  *=*) [[ \"${{@: -1}}\" == *={offered} ]] || exit 100 ;;\nesac\ncat {archive} >package_{offered}.deb"
            ),
        );
        self.program(
            "dpkg-deb",
            &format!("case $1 in\n  -f) echo {offered} ;;\n  --fsys-tarfile) cat \"$2\" ;;\nesac"),
        );
        self
    }

    /// Pins a version with a hash; without one, with that of the archive.
    fn with_lock(self, version: &str, hash: Option<&str>) -> Self {
        let hash = hash.map_or_else(|| self.hash(), str::to_owned);
        let line =
            format!("# comment\nswiftshader\tdebian\tchromium-common\t{version}\there\t{hash}\tApache-2.0\n");
        fs::write(self.path("tools/lock.tsv"), line).unwrap();
        self
    }

    fn hash(&self) -> String {
        let output = Command::new("sha256sum")
            .arg(self.path("package.deb"))
            .output()
            .unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        text.split(' ').next().unwrap().to_owned()
    }

    /// What `./x setup --full` says; it never fails.
    fn setup(&self) -> String {
        let output = Command::new(self.path("bin/bash"))
            .arg(self.path("x"))
            .args(["setup", "--full"])
            .env_clear()
            .env("PATH", self.path("bin"))
            .env("HOME", self.folder.path())
            .env("VK_DRIVER_FILES", "chosen")
            .output()
            .unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{said}");
        said
    }

    /// A package index that has DXC's package, a compiler that makes a program, and a lock that pins the package with a hash;
    /// without one, with its own.
    fn with_index(self, hash: Option<&str>) -> Self {
        let inside = self.path("sdist/parts-1.0");
        fs::create_dir_all(inside.join("parts/backends")).unwrap();
        for (file, content) in [
            ("parts/backends/libdxcompiler_x86_64.so.3.7", "the library"),
            ("parts/backends/WinAdapter.h", ""),
            ("parts/backends/dxcapi.h", ""),
            ("LICENSE", "its terms"),
        ] {
            fs::write(inside.join(file), content).unwrap();
        }
        let archive = self.path("package.deb");
        let mut pack = Command::new("tar");
        pack.arg("-czf").arg(&archive).arg("-C").arg(self.path("sdist"));
        assert!(pack.arg("parts-1.0").status().unwrap().success());
        let archive = archive.display();
        self.program("uname", "echo here");
        self.program(
            "python3",
            &format!(
                "case \"$*\" in\n  *' download '*) while [ \"$1\" != --dest ]; do shift; done; cp {archive} \"$2/parts-1.0.tar.gz\" ;;\nesac"
            ),
        );
        self.program(
            "g++",
            "while [ \"$1\" != -o ]; do shift; done\nprintf '#!/bin/true\\n' >\"$2\"\nchmod +x \"$2\"",
        );
        let hash = hash.map_or_else(|| self.hash(), str::to_owned);
        let line = format!("dxc\tpypi\tparts\t1.0\there\t{hash}\tNCSA\n");
        fs::write(self.path("tools/lock.tsv"), line).unwrap();
        self
    }

    /// A registry that has Dawn's package, a node that runs anything, and a lock that pins the package with a hash; without one, with its
    /// own.
    fn with_registry(self, hash: Option<&str>) -> Self {
        let inside = self.path("npm/package");
        fs::create_dir_all(inside.join("dist/linux-x64")).unwrap();
        for (file, content) in [
            ("dist/linux-x64/dawn.node", "the library"),
            ("package.json", "{}"),
            ("LICENSE.md", "its terms"),
        ] {
            fs::write(inside.join(file), content).unwrap();
        }
        let archive = self.path("package.deb");
        let mut pack = Command::new("tar");
        pack.arg("-czf").arg(&archive).arg("-C").arg(self.path("npm"));
        assert!(pack.arg("package").status().unwrap().success());
        let archive = archive.display();
        self.program("uname", "echo here");
        self.program("node", "exit 0");
        self.program(
            "npm",
            &format!(
                "[[ \"$*\" == *' --ignore-scripts '*'webgpu@1.0' ]] || exit 1\nwhile [ \"$1\" != --pack-destination ]; do shift; done\ncp {archive} \"$2/webgpu-1.0.tgz\""
            ),
        );
        let hash = hash.map_or_else(|| self.hash(), str::to_owned);
        let line = format!("dawn\tnpm\twebgpu\t1.0\there\t{hash}\tBSD-3-Clause\n");
        fs::write(self.path("tools/lock.tsv"), line).unwrap();
        self
    }

    /// Everything in the cache's folder of tools, hidden things too.
    fn cached(&self) -> Vec<String> {
        let Ok(entries) = fs::read_dir(self.path(".cache/bossage/tools")) else {
            return Vec::new();
        };
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    fn record(&self) -> String {
        fs::read_to_string(self.path(".cache/bossage/tools/swiftshader/fetched.tsv")).unwrap()
    }
}

#[test]
fn what_is_pinned_is_fetched_once() {
    let place = Place::new().with_debian("1.0").with_lock("1.0", None);
    let said = place.setup();
    assert!(said.contains("swiftshader 1.0 (Apache-2.0) is in"), "{said}");
    assert_eq!(place.cached(), ["swiftshader"]);
    let tool = place.path(".cache/bossage/tools/swiftshader");
    assert_eq!(
        fs::read_to_string(tool.join("libvk_swiftshader.so")).unwrap(),
        "the driver"
    );
    assert_eq!(
        place.record(),
        format!("swiftshader\t1.0\t1.0\t{}\n", place.hash())
    );
    let again = place.setup();
    assert!(!again.contains("fetching swiftshader"), "{again}");
}

#[test]
fn a_package_with_another_hash_is_not_used() {
    let wrong = "0".repeat(64);
    let place = Place::new().with_debian("1.0").with_lock("1.0", Some(&wrong));
    let said = place.setup();
    assert!(
        said.contains(&place.hash()) && said.contains("it is not used"),
        "{said}"
    );
    assert!(said.contains("DISABLED the second Vulkan driver"), "{said}");
    assert_eq!(place.cached(), [""; 0]);
}

#[test]
fn where_the_pinned_version_is_gone_what_came_instead_is_said_and_recorded() {
    let place = Place::new().with_debian("2.0").with_lock("1.0", None);
    let said = place.setup();
    assert!(
        said.contains("version 1.0 is no longer offered; took 2.0"),
        "{said}"
    );
    assert_eq!(
        place.record(),
        format!("swiftshader\t1.0\t2.0\t{}\n", place.hash())
    );
    assert!(
        !place.setup().contains("fetching swiftshader"),
        "it is not fetched again"
    );
}

#[test]
fn without_debian_the_way_to_get_it_is_said() {
    let place = Place::new();
    fs::write(place.path("tools/lock.tsv"), "").unwrap();
    let said = place.setup();
    let disabled = said
        .lines()
        .find(|line| line.contains("DISABLED the second Vulkan driver"));
    assert!(
        disabled.is_some_and(|line| line.contains("libvk_swiftshader.so") && line.contains("Chromium")),
        "{said}"
    );
    assert_eq!(place.cached(), [""; 0]);
}

#[test]
fn a_compiler_is_built_linked_and_fetched_once() {
    let place = Place::new().with_index(None);
    let said = place.setup();
    assert!(said.contains("dxc 1.0 (NCSA) is in"), "{said}");
    assert_eq!(place.cached(), ["bin", "dxc"]);
    let tools = place.path(".cache/bossage/tools");
    let library = fs::read_to_string(tools.join("bin/../dxc/lib/libdxcompiler.so")).unwrap();
    assert_eq!(library, "the library");
    assert!(
        tools.join("bin/dxc").is_file(),
        "a link that leads to the program"
    );
    assert!(!place.setup().contains("fetching dxc"), "it is not fetched again");
}

#[test]
fn a_compiler_with_another_hash_is_not_built() {
    let wrong = "0".repeat(64);
    let place = Place::new().with_index(Some(&wrong));
    let said = place.setup();
    assert!(
        said.contains(&place.hash()) && said.contains("it is not used"),
        "{said}"
    );
    assert!(said.contains("DISABLED route hlsl"), "{said}");
    assert_eq!(place.cached(), [""; 0]);
}

#[test]
fn without_a_compiler_to_build_it_with_the_way_is_said() {
    let place = Place::new().with_index(None);
    fs::remove_file(place.path("bin/g++")).unwrap();
    let said = place.setup();
    assert!(
        said.contains("its program is built by g++, which is missing"),
        "{said}"
    );
    assert!(
        said.contains("DISABLED route hlsl") && said.contains("put a dxc on the PATH"),
        "{said}"
    );
    assert_eq!(place.cached(), [""; 0]);
}

#[test]
fn a_package_of_the_registry_is_unpacked_linked_and_fetched_once() {
    let place = Place::new().with_registry(None);
    let said = place.setup();
    assert!(said.contains("dawn 1.0 (BSD-3-Clause) is in"), "{said}");
    assert_eq!(place.cached(), ["bin", "dawn"]);
    let tools = place.path(".cache/bossage/tools");
    let library = fs::read_to_string(tools.join("bin/../dawn/lib/dawn.node")).unwrap();
    assert_eq!(library, "the library");
    assert!(
        tools.join("bin/dawn").is_file(),
        "a link that leads to the program"
    );
    assert!(
        !place.setup().contains("fetching dawn"),
        "it is not fetched again"
    );
}

#[test]
fn a_package_of_the_registry_with_another_hash_is_not_used() {
    let wrong = "0".repeat(64);
    let place = Place::new().with_registry(Some(&wrong));
    let said = place.setup();
    assert!(
        said.contains(&place.hash()) && said.contains("it is not used"),
        "{said}"
    );
    assert!(said.contains("DISABLED route tint"), "{said}");
    assert_eq!(place.cached(), [""; 0]);
}

#[test]
fn without_node_the_way_is_said() {
    let place = Place::new().with_registry(None);
    fs::remove_file(place.path("bin/node")).unwrap();
    let said = place.setup();
    assert!(
        said.contains("its program is run by node, which is missing"),
        "{said}"
    );
    assert!(
        said.contains("DISABLED route tint") && said.contains("node 20 or later"),
        "{said}"
    );
    assert_eq!(place.cached(), [""; 0]);
}

#[test]
fn what_only_tests_need_is_installed_for_them_and_named_where_it_is_missing() {
    let place = Place::new().with_debian("1.0").with_lock("1.0", None);
    fs::remove_file(place.path("bin/chromium")).unwrap();
    let said = place.setup();
    assert!(said.contains("setup: installing chromium\n"), "{said}");
    let disabled = "DISABLED the test of the report page in a browser (chromium is missing)";
    assert!(said.contains(disabled), "{said}");
}

#[test]
fn clang_is_installed_with_the_rest_and_named_where_it_is_missing() {
    let place = Place::new().with_debian("1.0").with_lock("1.0", None);
    fs::remove_file(place.path("bin/clang")).unwrap();
    let said = place.setup();
    assert!(said.contains("setup: installing clang\n"), "{said}");
    let disabled = "DISABLED route msl and the external check of MSL (clang is missing)";
    assert!(said.contains(disabled), "{said}");
}

#[test]
fn the_lock_has_everything_that_is_asked_for() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let lock = fs::read_to_string(root.join("tools/lock.tsv")).unwrap();
    let script = fs::read_to_string(root.join("tools/full.sh")).unwrap();
    let names = script
        .split("full_tools=\"")
        .nth(1)
        .and_then(|rest| rest.split('"').next())
        .unwrap();
    for name in names.split_whitespace() {
        let line = lock.lines().find(|line| line.starts_with(&format!("{name}\t")));
        let columns: Vec<&str> = line.unwrap_or_else(|| panic!("no {name}")).split('\t').collect();
        assert_eq!(columns.len(), 7, "{name}");
        assert!(
            columns[5].len() == 64 && columns[5].bytes().all(|b| b.is_ascii_hexdigit()),
            "{name}"
        );
    }
}
