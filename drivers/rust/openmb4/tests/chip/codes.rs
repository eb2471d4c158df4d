// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

//! The numbers and names of the errors, which lib.rs repeats.

/// Each code that mb4_cyclic.h returns has the error of its number and name.
#[test]
fn every_code_of_the_header_is_named() {
    let names = include_str!("../../../../include/mb4_types.h");
    let header = include_str!("../../../../include/mb4_cyclic.h");
    let library = include_str!("../../src/lib.rs");
    let mut found = 0;
    for line in names.lines() {
        let mut sides = line.trim().trim_end_matches(',').split(" = ");
        let (name, number) = (sides.next().unwrap(), sides.next().unwrap_or_default());
        let is_code = number.parse::<u8>().map_or(false, |number| (1..=22).contains(&number));
        let used =
            header.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == name);
        if !is_code || !used || name == "MB4_SLAVES" {
            continue;
        }
        let camel: String = name[4..]
            .split('_')
            .map(|word| word[..1].to_string() + &word[1..].to_lowercase())
            .collect();
        assert!(library.contains(&format!("/// {number}: ")), "{name}");
        assert!(
            ["InvalidArgument", "Transport"].contains(&&*camel)
                || library.contains(&format!(" {number} => Self::{camel},")),
            "{name}"
        );
        found += 1;
    }
    assert_eq!(found, 13);
}
