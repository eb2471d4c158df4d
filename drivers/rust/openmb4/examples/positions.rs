// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

//! A loop that a board's `main()` calls with its SPI, delay and clock: an encoder of 26 bits, 1000
//! positions a second. `show` gets each new position, or what has happened instead; false ends.
#![no_std]

use embedded_hal::{delay::DelayNs, spi::SpiDevice};
use openmb4::{Config, Encoder, Error, SpiCheck};

pub const ENCODER: Config = Config {
    f_clk_hz: 20_000_000,
    max_ma_hz: 2_500_000,
    frame_period_ns: 1_000_000,
    crc_polynomial: 0x43,
    crc_start: 0,
    data_bits: 28, // 26 position, nE, nW
    spi_check: SpiCheck::Full,
    error_warning: true,
    internal_clock: false,
    on_pin: false,
};

pub fn run<SPI: SpiDevice, D: DelayNs>(
    spi: SPI,
    mut delay: D,
    now_us: impl Fn() -> u32,
    mut show: impl FnMut(Result<u64, Error<SPI::Error>>) -> bool,
) -> Result<(), Error<SPI::Error>> {
    let mut encoder = Encoder::new(spi, &ENCODER)?;
    encoder.start(&mut delay)?;
    while {
        delay.delay_us(1000);
        let reading = encoder.read(now_us());
        match reading {
            Ok(_) | Err(Error::NoData | Error::Crc | Error::SlaveError) => {}
            Err(Error::Corrupted | Error::NotDetected) if encoder.verify().is_ok() => {}
            Err(_) => encoder.start(&mut delay)?,
        }
        show(reading.map(|reading| reading.position))
    } {}
    Ok(())
}
