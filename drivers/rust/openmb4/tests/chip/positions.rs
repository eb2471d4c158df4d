// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

//! Right positions of the simulated chip. What is expected comes from the scenario's ramp and from
//! the encoder's own count of its frames.

use std::ffi::CStr;

use openmb4::{Config, Encoder, Error, SpiCheck};

use crate::example;
use crate::simulator::{Chip, Drive, CONFIG, START, STEP};

const CHECKS: [SpiCheck; 3] = [SpiCheck::Crc, SpiCheck::Full, SpiCheck::FullAndRelease];

#[test]
fn each_frame_brings_its_position_once() {
    for spi_check in CHECKS {
        // Bits, polynomial, start value; SCDATAx stores no CRC beside 64 data bits, and the last
        // polynomial is no predefined one.
        for (data_bits, crc_polynomial, crc_start) in [
            (28, 0x43, 0),
            (36, 0x43, 0x15),
            (48, 0x190D9, 0x1234),
            (32, 0x12F, 0xA5),
            (64, 0x43, 0),
            (20, 0, 0),
            (26, 0x61, 1),
        ] {
            let config = Config { data_bits, crc_polynomial, crc_start, spi_check, ..CONFIG };
            let mut drive = Drive::new(&config, "");
            for _ in 0..5 {
                let reading = drive.next().unwrap_or_else(|error| panic!("{error:?}, {config:?}"));
                assert_eq!(reading.position, drive.expected(), "{config:?}");
                assert_eq!(reading.raw, drive.expected() << 2 | 3, "{config:?}");
                assert!(!reading.warning);
                assert_eq!(drive.read(), Err(Error::NoData), "{config:?}");
            }
        }
    }
}

#[test]
fn transfers_are_those_of_the_comment() {
    for (spi_check, new, none) in [(CHECKS[0], 4, 4), (CHECKS[1], 7, 3), (CHECKS[2], 8, 4)] {
        let mut drive = Drive::new(&Config { spi_check, ..CONFIG }, "");
        drive.next().unwrap();
        drive.chip.undisturbed();
        drive.next().unwrap();
        assert_eq!(drive.chip.undisturbed().len(), new, "{spi_check:?}");
        assert_eq!(drive.read(), Err(Error::NoData));
        assert_eq!(drive.chip.undisturbed().len(), none, "{spi_check:?}");
    }
}

#[test]
fn the_first_read_drops_what_waits() {
    let mut drive = Drive::new(&CONFIG, "");
    drive.next().unwrap();
    drive.encoder.start(&mut drive.chip.clone()).unwrap();
    assert_eq!(drive.next(), Err(Error::NoData));
    assert_eq!(drive.next().unwrap().position, drive.expected());
}

#[test]
fn the_last_position_is_followed_by_the_first() {
    let chip = Chip::new("data_bits = 28\nsource = \"ramp\"\nstart = 0x3FFFFFD\nstep = 1", "");
    let mut encoder = Encoder::new(chip.clone(), &CONFIG).unwrap();
    encoder.start(&mut chip.clone()).unwrap();
    assert_eq!(encoder.read(chip.now_us()), Err(Error::NoData));
    for _ in 0..6 {
        assert!(chip.next_frame());
        let reading = encoder.read(chip.now_us()).unwrap();
        assert_eq!(reading.position, (0x3FF_FFFD + chip.frames() - 1) % (1 << 26));
    }
}

#[test]
fn a_word_without_flags_is_all_position() {
    let mut drive = Drive::new(&Config { error_warning: false, ..CONFIG }, "");
    let reading = drive.next().unwrap();
    assert_eq!((reading.position, reading.raw), (drive.expected(), drive.expected()));
}

#[test]
fn a_warning_is_told_with_its_position() {
    let mut drive = Drive::new(&CONFIG, "flags = 2");
    let reading = drive.next().unwrap();
    assert_eq!((reading.position, reading.warning), (drive.expected(), true));
}

#[test]
fn pulses_start_the_frames() {
    let config = Config { on_pin: true, frame_period_ns: 300_000, ..CONFIG };
    let mut drive = Drive::new(&config, "");
    for frame in 0..5 {
        assert_eq!(drive.chip.frames(), frame);
        drive.chip.pulse(CStr::from_bytes_with_nul(b"GETSENS\0").unwrap());
        drive.chip.advance_us(298);
        assert_eq!(drive.read().unwrap().position, START + STEP * frame);
    }
}

#[test]
fn the_internal_clock_makes_frames() {
    let mut drive = Drive::new(&Config { internal_clock: true, ..CONFIG }, "");
    assert_eq!(drive.next().unwrap().position, drive.expected());
}

#[test]
fn an_encoder_may_be_moved_between_reads() {
    let mut drive = Drive::new(&CONFIG, "");
    drive.next().unwrap();
    for _ in 0..3 {
        let mut moved = Box::new(drive);
        assert_eq!(moved.next().unwrap().position, moved.expected());
        drive = *moved;
    }
}

#[test]
fn frames_that_no_read_has_brought_are_counted() {
    let mut drive = Drive::new(&CONFIG, "");
    drive.next().unwrap();
    assert!(drive.chip.next_frame());
    assert!(drive.chip.next_frame());
    drive.next().unwrap();
    let counts = drive.encoder.counts();
    assert_eq!((counts.good, counts.lost, counts.sequence, counts.late), (2, 2, 4, 1));
    assert_eq!((counts.doubtful, counts.crc, counts.faults), (0, 0, 0));
}

#[test]
fn the_example_shows_positions() {
    let Config { data_bits, crc_polynomial, .. } = example::ENCODER;
    let chip = Chip::new(&format!(
        "data_bits = {data_bits}\ncrc = {crc_polynomial}\nsource = \"ramp\"\nstart = {START}\nstep = {STEP}"
    ), "");
    let mut positions = Vec::new();
    example::run(
        chip.clone(),
        chip.clone(),
        || chip.now_us(),
        |shown| {
            if let Ok(position) = shown {
                assert_eq!(position, START + STEP * (chip.frames() - 1));
                positions.push(position);
            }
            positions.len() < 5
        },
    )
    .unwrap();
    assert!(positions.windows(2).all(|pair| pair[1] == pair[0] + STEP), "{positions:?}");
}

#[test]
fn the_example_refuses_a_slave_error() {
    let chip = Chip::new("data_bits = 28\nsource = \"ramp\"\nflags = 1", "");
    let mut reads = 0;
    example::run(
        chip.clone(),
        chip.clone(),
        || chip.now_us(),
        |shown| {
            assert!(shown.is_err());
            reads += 1;
            reads < 5 || shown != Err(Error::SlaveError)
        },
    )
    .unwrap();
}

#[test]
fn what_the_chip_cannot_do_is_refused() {
    let wrong = [
        Config { f_clk_hz: 999_999, ..CONFIG },
        Config { f_clk_hz: 25_000_001, ..CONFIG },
        Config { f_clk_hz: 9_999_999, internal_clock: true, ..CONFIG },
        Config { max_ma_hz: 62_499, ..CONFIG }, // below 20 MHz / 320
        Config { max_ma_hz: 62_500, ..CONFIG }, // a frame is longer than its period
        Config { frame_period_ns: 999, ..CONFIG },
        Config { frame_period_ns: 4_000_001, ..CONFIG }, // 80,000 clocks
        Config { frame_period_ns: 15_000, ..CONFIG },    // 39.55 periods of 0.4 us: 15.82 us
        Config { frame_period_ns: 1_000_000_001, on_pin: true, ..CONFIG },
        Config { crc_polynomial: 0x42, ..CONFIG },
        Config { crc_polynomial: 0x180D9, ..CONFIG },
        Config { data_bits: 0, ..CONFIG },
        Config { data_bits: 65, ..CONFIG },
        Config { data_bits: 1, ..CONFIG }, // and two flags
    ];
    let chip = Chip::new("data_bits = 28", "");
    for config in wrong {
        let refused = Encoder::new(chip.clone(), &config).map(|_| ());
        assert_eq!(refused, Err(Error::InvalidConfig), "{config:?}");
    }
    assert!(chip.undisturbed().is_empty());
    for good in [
        Config { max_ma_hz: 62_500, frame_period_ns: 4_000_000, ..CONFIG },
        Config { frame_period_ns: 16_000, ..CONFIG },
        Config { data_bits: 2, ..CONFIG },
    ] {
        assert!(Encoder::new(chip.clone(), &good).is_ok(), "{good:?}");
    }
}
