// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

//! Compiles the read path in C99 for the target. The headers are those of the repository.

fn main() {
    let headers = ["../../include", "../../../regmap/generated/mb4"];
    cc::Build::new()
        .file("src/read_path.c")
        .includes(headers)
        .flag_if_supported("-std=c99")
        .compile("openmb4_read_path");
    println!("cargo:rerun-if-changed=src/read_path.c");
    for folder in headers {
        println!("cargo:rerun-if-changed={folder}");
    }

    println!("cargo:rerun-if-env-changed=MB4SIM_LIB");
    if let (Ok(_), Ok(folder)) =
        (std::env::var("CARGO_FEATURE_SIMULATOR"), std::env::var("MB4SIM_LIB"))
    {
        println!("cargo:rustc-link-search=native={folder}");
        println!("cargo:rustc-link-arg-tests=-Wl,-rpath,{folder}");
    }
}
