//! Compiles the C of the drive with the C compiler that CC names, else cc; no product is fused into a sum.

use std::env;
use std::path::PathBuf;
use std::process::Command;

fn run(program: &str, arguments: &[&str]) {
    let status = Command::new(program).args(arguments).status();
    match status {
        Ok(status) if status.success() => {}
        Ok(status) => panic!("{} ended with {}", program, status),
        Err(error) => panic!("{} cannot be run ({}): name a C compiler in CC, an archiver in AR", program, error),
    }
}

fn main() {
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo sets OUT_DIR"));
    let compiler = env::var("CC").unwrap_or_else(|_| "cc".into());
    let archiver = env::var("AR").unwrap_or_else(|_| "ar".into());
    let (object, archive) = (out.join("mesh.o"), out.join("libmesh_c.a"));
    let (object, archive) = (object.to_str().expect("a path in UTF-8"), archive.to_str().expect("a path in UTF-8"));
    let flags = ["-std=c99", "-O2", "-fPIC", "-ffp-contract=off", "-fno-math-errno", "-Ic", "-c", "c/mesh.c", "-o", object];
    run(&compiler, &flags);
    run(&archiver, &["crs", archive, object]);
    println!("cargo:rustc-link-search=native={}", out.display());
    println!("cargo:rustc-link-lib=static=mesh_c");
    println!("cargo:rerun-if-changed=c");
    println!("cargo:rerun-if-env-changed=CC");
}
