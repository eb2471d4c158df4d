// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

//! Faults of SPI, line and encoder on the simulated chip: an `Err`, never an old or wrong position.

use embedded_hal::spi::SpiDevice;
use openmb4::{Config, Encoder, Error, SpiCheck};

use crate::simulator::{Answer, BusError, Chip, Drive, Fault, CONFIG};

#[test]
fn a_word_with_ne_0_is_no_position() {
    for spi_check in [SpiCheck::Crc, SpiCheck::Full, SpiCheck::FullAndRelease] {
        let mut drive = Drive::new(&Config { spi_check, ..CONFIG }, "");
        drive.next().unwrap();
        for (raw, good) in
            [(500 << 2 | 3, true), (500 << 2 | 1, false), (7 << 2, false), (9 << 2 | 3, true)]
        {
            drive.chip.set_data(raw);
            assert!(drive.chip.next_frame());
            let answer = drive.next();
            if good {
                assert_eq!(answer.unwrap().position, raw >> 2);
            } else {
                assert_eq!(answer, Err(Error::SlaveError));
            }
        }
        assert_eq!(drive.encoder.counts().slave_errors, 2);
    }
}

/// All faults of a transfer of `bytes` bytes.
fn faults(bytes: usize) -> Vec<Fault> {
    let flips = (0..8 * bytes).flat_map(|bit| [Fault::Mosi(bit), Fault::Miso(bit)]);
    [Fault::Left, Fault::Unstored, Fault::Failed, Fault::Miso0, Fault::Miso1]
        .into_iter()
        .chain(flips)
        .collect()
}

/// A read of a new word, or of none.
fn disturbed(drive: &mut Drive, new: bool, at: usize, fault: Fault) -> (u64, Answer) {
    drive.recover();
    if new {
        assert!(drive.chip.next_frame());
    }
    drive.chip.disturb(at, fault);
    (drive.expected(), drive.read())
}

#[test]
fn a_disturbed_transfer_makes_no_position() {
    for spi_check in [SpiCheck::Full, SpiCheck::FullAndRelease] {
        for (new, crc_polynomial) in [(true, 0x43), (true, 0x12F), (false, 0x43)] {
            let mut drive = Drive::new(&Config { spi_check, crc_polynomial, ..CONFIG }, "");
            let _ = disturbed(&mut drive, new, 99, Fault::Left);
            for (at, bytes) in drive.chip.undisturbed().into_iter().enumerate() {
                for fault in faults(bytes) {
                    let (expected, answer) = disturbed(&mut drive, new, at, fault);
                    assert!(drive.chip.undisturbed().len() > at);
                    let what =
                        format!("{spi_check:?}, transfer {at}, {fault:?}, new: {new}: {answer:?}");
                    match answer {
                        Ok(reading) => assert!(new && reading.position == expected, "{what}"),
                        Err(Error::Transport(BusError)) => {
                            assert_eq!(fault, Fault::Failed, "{what}")
                        }
                        Err(_) => assert_ne!(fault, Fault::Failed, "{what}"),
                    }
                }
            }
        }
    }
}

#[test]
fn a_bus_that_is_dead_from_some_transfer_on_brings_nothing() {
    for spi_check in [SpiCheck::Crc, SpiCheck::Full, SpiCheck::FullAndRelease] {
        for fault in [Fault::Miso0, Fault::Miso1] {
            let mut drive = Drive::new(&Config { spi_check, ..CONFIG }, "");
            let _ = disturbed(&mut drive, true, 99, fault);
            for at in 0..drive.chip.undisturbed().len() {
                let (expected, answer) = disturbed(&mut drive, true, at, fault);
                // The position may have come before the bus died.
                assert!(answer.map_or(true, |reading| reading.position == expected));
                for _ in 0..3 {
                    assert_eq!(
                        drive.next(),
                        Err(Error::NotDetected),
                        "{spi_check:?}, {fault:?}, {at}"
                    );
                }
                assert_eq!(drive.encoder.verify(), Err(Error::NotDetected));
                assert_eq!(drive.read(), Err(Error::NotConfigured));
                assert_eq!(drive.encoder.start(&mut drive.chip.clone()), Err(Error::NotDetected));
                drive.chip.undisturbed();
                drive.encoder.start(&mut drive.chip.clone()).unwrap();
                drive.recover();
            }
        }
    }
}

#[test]
fn a_bus_that_stores_nothing_brings_nothing() {
    for spi_check in [SpiCheck::Crc, SpiCheck::Full, SpiCheck::FullAndRelease] {
        let mut drive = Drive::new(&Config { spi_check, ..CONFIG }, "");
        drive.recover();
        drive.chip.disturb(0, Fault::NeverStored);
        for _ in 0..3 {
            let answer = drive.next();
            assert!(
                matches!(answer, Err(Error::NotDetected | Error::Corrupted)),
                "{spi_check:?}: {answer:?}"
            );
        }
        drive.chip.undisturbed();
        drive.recover();
    }
}

#[test]
fn a_failing_bus_is_told_with_its_error() {
    let mut drive = Drive::new(&CONFIG, "");
    drive.chip.disturb(0, Fault::Failed);
    assert_eq!(drive.next(), Err(Error::Transport(BusError)));
    for at in 0..4 {
        drive.chip.disturb(at, Fault::Failed);
        assert_eq!(drive.encoder.start(&mut drive.chip.clone()), Err(Error::Transport(BusError)));
        assert_eq!(drive.read(), Err(Error::NotConfigured));
    }
    drive.encoder.start(&mut drive.chip.clone()).unwrap();
    drive.recover();
}

#[test]
fn a_disturbed_start_ends_in_an_error_or_in_positions() {
    let mut drive = Drive::new(&CONFIG, "");
    drive.chip.undisturbed();
    drive.encoder.start(&mut drive.chip.clone()).unwrap();
    for (at, bytes) in drive.chip.undisturbed().into_iter().enumerate() {
        for fault in faults(bytes) {
            drive.chip.disturb(at, fault);
            let started = drive.encoder.start(&mut drive.chip.clone());
            drive.chip.undisturbed();
            for _ in 0..3 {
                if started.is_err() {
                    assert_eq!(drive.read(), Err(Error::NotConfigured));
                    continue;
                }
                let came = drive.chip.next_frame();
                if let Ok(reading) = drive.read() {
                    let right = came && reading.position == drive.expected();
                    assert!(right, "transfer {at}, {fault:?}: {reading:?}");
                }
            }
        }
    }
    drive.recover();
}

#[test]
fn a_flipped_bit_of_the_line_is_told_once() {
    for spi_check in [SpiCheck::Crc, SpiCheck::Full, SpiCheck::FullAndRelease] {
        let mut drive = Drive::new(&Config { spi_check, ..CONFIG }, "");
        drive.next().unwrap();
        drive.chip.inject("[[fault]]\nkind = \"bit-flip\"\nchannel = 1\nat_us = 0\nbits = [9]\n");
        assert_eq!(drive.next(), Err(Error::Crc), "{spi_check:?}");
        assert_eq!(drive.read(), Err(Error::NoData));
        assert_eq!(drive.next().unwrap().position, drive.expected());
        assert_eq!(drive.encoder.counts().crc, 1);
    }
}

#[test]
fn an_unplugged_cable_is_told_within_two_periods() {
    for (open_level, told) in [(1, Error::Timeout), (0, Error::LineError)] {
        let mut drive = Drive::on_channel(&CONFIG, "", &format!("open_level = {open_level}"));
        drive.next().unwrap();
        drive.chip.cable("unplug");
        let mut answers = Vec::new();
        for _ in 0..4 {
            drive.chip.advance_us(500);
            answers.push(drive.read());
        }
        assert!(answers.iter().all(Result::is_err), "{answers:?}");
        assert_eq!(answers[3], Err(told), "{answers:?}");
        drive.chip.cable("plug");
        drive.encoder.start(&mut drive.chip.clone()).unwrap();
        drive.recover();
    }
}

#[test]
fn an_encoder_that_sends_nothing_is_no_word() {
    let mut drive = Drive::new(&CONFIG, "");
    drive.next().unwrap();
    // Broadcast command 00 (table 44) on channel 1: single-cycle data of all slaves off.
    for bytes in [&[0x02, 0xE2, 0, 0, 1, 0x40][..], &[0x02, 0x80, 0], &[0x07, 0x09]] {
        drive.chip.clone().write(bytes).unwrap();
    }
    drive.chip.advance_us(80 * 500);
    assert_eq!(
        (0..3)
            .map(|_| {
                drive.chip.advance_us(500);
                drive.read()
            })
            .collect::<Vec<_>>(),
        [Err(Error::NoWord); 3]
    );
    assert_eq!(drive.encoder.counts().no_word, 3);
}

#[test]
fn a_changed_register_ends_the_reads() {
    let mut drive = Drive::new(&CONFIG, "");
    drive.next().unwrap();
    assert_eq!(drive.encoder.verify(), Ok(()));
    for (address, value) in
        [(0xC0, 0), (0xC1, 5), (0xC3, 1), (0xE6, 0xA4), (0xE8, 0), (0xED, 0x0F), (0xF5, 0x40)]
    {
        drive.chip.clone().write(&[0x02, address, value]).unwrap();
        assert_eq!(drive.encoder.verify(), Err(Error::Verify), "{address:#x}");
        assert_eq!(drive.read(), Err(Error::NotConfigured));
        assert_eq!(drive.encoder.verify(), Err(Error::NotConfigured));
        drive.encoder.start(&mut drive.chip.clone()).unwrap();
        drive.recover();
    }
}

#[test]
fn reads_need_a_start() {
    let chip = Chip::new("data_bits = 28", "");
    let mut encoder = Encoder::new(chip.clone(), &CONFIG).unwrap();
    assert_eq!(encoder.read(0), Err(Error::NotConfigured));
    assert!(chip.undisturbed().is_empty());
}
