// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

#![doc = include_str!("../README.md")]
#![no_std]
#![deny(missing_docs, unsafe_op_in_unsafe_fn, clippy::undocumented_unsafe_blocks)]

use core::{ptr, slice};
use embedded_hal::{delay::DelayNs, spi::SpiDevice};

/// What is checked on the SPI bus: `docs/driver.md`, "Faults of the SPI bus".
#[repr(u8)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpiCheck {
    /// The encoder's CRC over the bytes that SPI has brought, in 4 transfers. For a short bus on one
    /// board and an encoder with a CRC: a disturbed transfer may bring an old or a wrong position.
    Crc = 1,
    /// No single disturbed transfer and no stuck line makes a wrong or an old position, but for two
    /// bits of the last byte, which frees the data. 7 transfers for a new position, 3 without one.
    Full = 2,
    /// As `Full`, and one more transfer finds those two bits.
    FullAndRelease = 3,
}

/// The chip's clock, its frames and the encoder. Tables are those of the iC-MB4 datasheet.
#[repr(C)] // openmb4_config of read_path.c
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Config {
    /// System clock in Hz: 1'000'000 to 25'000'000; with `internal_clock` from 10'000'000 on.
    pub f_clk_hz: u32,
    /// MA in Hz: the highest frequency of table 35 that is not above this. At least `f_clk_hz / 320`.
    pub max_ma_hz: u32,
    /// Time from frame to frame in ns, 1000 to 1'000'000'000: the shortest one of table 37 that is
    /// not below this. It has to be longer than a frame with the encoder's timeout.
    pub frame_period_ns: u32,
    /// With its highest bit: 0x43 is x^6 + x + 1. 0 is none (tables 14 and 15).
    pub crc_polynomial: u32,
    /// Start value of the CRC. As many of the low bits count as the CRC has.
    pub crc_start: u16,
    /// Position and flags, without the CRC: 1 to 64.
    pub data_bits: u8,
    /// What is checked on the SPI bus, and how many transfers a read takes for it.
    pub spi_check: SpiCheck,
    /// The last two data bits are nE and nW, low-active error and warning.
    pub error_warning: bool,
    /// The chip's own oscillator makes the system clock (CLKENI, 0xF5). It may be two and a half
    /// times too slow, so nothing is counted as lost.
    pub internal_clock: bool,
    /// A pulse at pin GETSENS starts each frame, every `frame_period_ns` (as it stands).
    pub on_pin: bool,
}

/// A good new position.
#[repr(C)] // openmb4_reading of read_path.c
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reading {
    /// The data bits without nE and nW, right aligned: 0 to 2^62 - 1, without flags to 2^64 - 1.
    pub position: u64,
    /// All data bits, right aligned.
    pub raw: u64,
    /// nW is 0: the encoder reports a warning. Always false without [`Config::error_warning`].
    pub warning: bool,
}

/// What the reads have met since [`Encoder::new()`]: `mb4_counts` of `mb4_cyclic.h`, which states
/// when `lost` and `sequence` are exact. All wrap at 2^32.
#[repr(C)] // openmb4_counts of read_path.c
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Reads with a new position.
    pub good: u32,
    /// Reads with [`Error::SlaveError`].
    pub slave_errors: u32,
    /// Reads with a word whose CRC was wrong.
    pub crc: u32,
    /// Reads with [`Error::NoWord`].
    pub no_word: u32,
    /// Samples that no read has brought, by time; known with the next new one.
    pub lost: u32,
    /// Number of the last new sample; the first one is 1.
    pub sequence: u32,
    /// Reads later than one and a half periods after the last one.
    pub late: u32,
    /// Reads with another error.
    pub faults: u32,
    /// By so much `lost` and `sequence` may be wrong.
    pub doubtful: u32,
    /// The chip has left out a frame (nAGSERR).
    pub omits: bool,
}

/// Why there is no position. The numbers are those of `mb4.h`; `docs/driver.md`, "Errors", says what
/// to do. `E` is the error of the SPI device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Error<E> {
    /// 1: the library and its part in C do not fit together.
    InvalidArgument,
    /// 2: a member of [`Config`] is out of its range, or a frame is longer than its period.
    InvalidConfig,
    /// 3: the set-up needs a part of the read path that is left out.
    Unsupported,
    /// 4: [`Encoder::start()`] comes first; also after it or [`Encoder::verify()`] has failed.
    NotConfigured,
    /// 5: the SPI device has failed. The next read recovers by itself.
    Transport(E),
    /// 6: the answer cannot be from this chip: MISO stuck, wrong mode, no chip. Verify, read again.
    NotDetected,
    /// 7: a register reads back differently, or frames have not stopped. Start again.
    Verify,
    /// 8: frames stay away: the encoder does not answer, or there is no system clock. Start again.
    Timeout,
    /// 9: as `Timeout`, and SL is low where it must be high: line or supply of the encoder.
    LineError,
    /// 10: the CRC of a new word was wrong. Read again.
    Crc,
    /// 11: no new word since the last read. No fault in a loop that polls.
    NoData,
    /// 12: SPI has disturbed a transfer. Verify, read again.
    Corrupted,
    /// 18: frames have ended while the data was read. Read again. Only beside register accesses.
    BankSwitched,
    /// 21: a new word whose nE is 0: the encoder does not trust its position.
    SlaveError,
    /// 22: the encoder acknowledges and sends nothing: its data is off (command 00) or broken.
    NoWord,
}

impl<E> Error<E> {
    fn check(code: u8) -> Result<(), Self> {
        Err(match code {
            0 => return Ok(()),
            2 => Self::InvalidConfig,
            3 => Self::Unsupported,
            6 => Self::NotDetected,
            7 => Self::Verify,
            8 => Self::Timeout,
            9 => Self::LineError,
            10 => Self::Crc,
            11 => Self::NoData,
            12 => Self::Corrupted,
            18 => Self::BankSwitched,
            21 => Self::SlaveError,
            22 => Self::NoWord,
            _ => Self::InvalidArgument,
        })
    }
}

const TRANSPORT: u8 = 5; // MB4_TRANSPORT, MB4_MORE
const MORE: u8 = 255;
const FIRST: u8 = 0xC0; // register of the image, which ends with the interface byte 0xF5
const IMAGE: usize = 0xF5 - 0xC0 + 1;
const WRITTEN: usize = 0xF2 - 0xC0 + 1; // up to SVALID, which this clears
const BREAK: u8 = 0x80; // of 0xF4
const AGS: u8 = 0x01;
const WORDS: u32 = 56; // openmb4_begin() looks whether they are enough
type Memory = [u64; WORDS as usize]; // openmb4_encoder of read_path.c

extern "C" {
    fn openmb4_begin(memory: *mut Memory, bytes: u32, config: &Config, image: *mut u8) -> u8;
    fn openmb4_started(memory: *mut Memory);
    fn openmb4_compare(image: *const u8, rx: *const u8, running: bool) -> u8;
    fn openmb4_plan(memory: *mut Memory, now_us: u32) -> u8;
    fn openmb4_frame(memory: *const Memory, frame: u8, tx: &mut *const u8, rx: &mut *mut u8) -> u8;
    fn openmb4_finish(memory: *mut Memory, transferred: bool, now_us: u32) -> u8;
    fn openmb4_reading_of(memory: *const Memory, reading: &mut Reading);
    fn openmb4_counts_of(memory: *const Memory, counts: &mut Counts);
}

/// One encoder at channel 1 of a chip. It may be moved at any time.
pub struct Encoder<SPI> {
    spi: SPI,
    memory: Memory,
    image: [u8; IMAGE],
    running: bool,
}

impl<SPI: SpiDevice> Encoder<SPI> {
    /// Checks `config` and makes no transfer.
    ///
    /// # Errors
    /// [`Error::InvalidConfig`].
    pub fn new(spi: SPI, config: &Config) -> Result<Self, Error<SPI::Error>> {
        let mut new = Self { spi, memory: [0; WORDS as usize], image: [0; IMAGE], running: false };
        let (memory, image) = (&mut new.memory, new.image.as_mut_ptr());
        // SAFETY: the memory is all zeros, and it is as long as said; the image is IMAGE_BYTES long.
        Error::check(unsafe { openmb4_begin(memory, WORDS * 8, config, image) })?;
        Ok(new)
    }

    /// Ends frames that run, writes the registers, reads them back, and starts automatic frames: 4
    /// transfers and a pause of 133 us. The first read drops the words from before, so it may be
    /// [`Error::NoData`]. Start again after [`Error::Timeout`] and [`Error::LineError`].
    ///
    /// # Errors
    /// [`Error::Transport`], [`Error::NotDetected`], [`Error::Verify`]: the chip starts no frames.
    pub fn start<D: DelayNs>(&mut self, delay: &mut D) -> Result<(), Error<SPI::Error>> {
        self.running = false;
        self.spi.write(&[0x07, BREAK, self.image[IMAGE - 1]]).map_err(Error::Transport)?;
        delay.delay_us(133); // until the encoder of a frame that BREAK has cut is ready again
        let mut tx = [0x02; 2 + WRITTEN];
        tx[1] = FIRST;
        tx[2..].copy_from_slice(&self.image[..WRITTEN]);
        self.spi.write(&tx).map_err(Error::Transport)?;
        self.compare()?;
        self.spi.write(&[0x07, AGS]).map_err(Error::Transport)?;
        // SAFETY: new() has prepared the memory.
        unsafe { openmb4_started(&mut self.memory) };
        self.running = true;
        Ok(())
    }

    /// Compares the registers in one transfer: once a second, and after [`Error::Corrupted`] and
    /// [`Error::NotDetected`]. If they differ, reads need [`Encoder::start()`] first.
    ///
    /// # Errors
    /// [`Error::NotConfigured`], [`Error::Transport`], [`Error::NotDetected`], [`Error::Verify`].
    pub fn verify(&mut self) -> Result<(), Error<SPI::Error>> {
        if !self.running {
            return Err(Error::NotConfigured);
        }
        let compared = self.compare();
        self.running = matches!(compared, Ok(()) | Err(Error::Transport(_)));
        compared
    }

    /// The position of the newest frame, once. It never waits. A bad word and a disturbed transfer
    /// need more transfers than [`SpiCheck`] states. `now_us` is a counter of microseconds that wraps
    /// at 2^32, in steps of at most 32.
    ///
    /// # Errors
    /// All of [`Error`] but `InvalidConfig` and `Verify`. Frames that stay away are `Timeout` or
    /// `LineError`: after two periods if the chip has left some out, otherwise after 16 to 64.
    pub fn read(&mut self, now_us: u32) -> Result<Reading, Error<SPI::Error>> {
        if !self.running {
            return Err(Error::NotConfigured);
        }
        let memory: *mut Memory = &mut self.memory;
        // SAFETY: new() has prepared the memory. Pointers into it are set here; until this function
        // ends it stays where it is, and is used by `memory` alone.
        Error::check(unsafe { openmb4_plan(memory, now_us) })?;
        let (mut fault, mut code) = (None, MORE);
        while code == MORE {
            let made = make_frames(&mut self.spi, memory);
            // SAFETY: openmb4_plan() has begun the read, which has not ended.
            code = unsafe { openmb4_finish(memory, made.is_ok(), now_us) };
            fault = fault.or(made.err());
        }
        if let (Some(error), TRANSPORT) = (fault, code) {
            return Err(Error::Transport(error));
        }
        Error::check(code)?;
        let mut reading = Reading { position: 0, raw: 0, warning: false };
        // SAFETY: the read has ended with MB4_OK.
        unsafe { openmb4_reading_of(memory, &mut reading) };
        Ok(reading)
    }

    /// What the reads have met.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        // SAFETY: new() has prepared the memory.
        unsafe { openmb4_counts_of(&self.memory, &mut counts) };
        counts
    }

    /// The SPI device, for example for a faster SCLK after [`Encoder::start()`].
    pub fn spi(&mut self) -> &mut SPI {
        &mut self.spi
    }

    // It sends the right registers: should a disturbed opcode write them, nothing changes.
    fn compare(&mut self) -> Result<(), Error<SPI::Error>> {
        let (mut tx, mut rx) = ([0x03; 2 + IMAGE], [0; 2 + IMAGE]);
        tx[1] = FIRST;
        tx[2..].copy_from_slice(&self.image);
        tx[IMAGE] = u8::from(self.running) * AGS; // 0xF4, the last but one
        self.spi.transfer(&mut rx, &tx).map_err(Error::Transport)?;
        // SAFETY: image and answer have the lengths that it reads.
        Error::check(unsafe { openmb4_compare(self.image.as_ptr(), rx.as_ptr(), self.running) })
    }
}

// The SPI frames of the plan in the memory of a read that has begun.
fn make_frames<SPI: SpiDevice>(spi: &mut SPI, memory: *mut Memory) -> Result<(), SPI::Error> {
    let (mut tx, mut rx) = (ptr::null(), ptr::null_mut());
    for frame in 0.. {
        // SAFETY: the memory holds a plan.
        let size = usize::from(unsafe { openmb4_frame(memory, frame, &mut tx, &mut rx) });
        if size == 0 {
            break;
        }
        // SAFETY: `size` bytes each inside the memory, which nobody else uses meanwhile; what is sent
        // and what is received have nothing in common.
        let (out, back) =
            unsafe { (slice::from_raw_parts(tx, size), slice::from_raw_parts_mut(rx, size)) };
        spi.transfer(back, out)?;
    }
    Ok(())
}
