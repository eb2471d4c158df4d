// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0

//! The simulated chip (`sim/include/mb4sim.h`) as a `SpiDevice` that can disturb one transfer.

use std::cell::{Cell, RefCell};
use std::ffi::{c_void, CStr, CString};
use std::os::raw::{c_char, c_int};
use std::{ptr, rc::Rc};

use embedded_hal::delay::DelayNs;
use embedded_hal::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use openmb4::{Config, Encoder, Error, Reading, SpiCheck};

#[link(name = "mb4sim")]
extern "C" {
    fn mb4sim_open(text: *const c_char, error: *mut c_char, size: usize) -> *mut c_void;
    fn mb4sim_close(sim: *mut c_void);
    fn mb4sim_spi_transfer(sim: *mut c_void, tx: *const u8, rx: *mut u8, n: usize) -> c_int;
    fn mb4sim_advance_ns(sim: *mut c_void, ns: u64);
    fn mb4sim_time_ns(sim: *const c_void) -> u64;
    fn mb4sim_slave_frames(sim: *const c_void, slave: u32) -> u64;
    fn mb4sim_slave_set_data(sim: *mut c_void, slave: u32, raw: u64) -> c_int;
    fn mb4sim_pin_write(sim: *mut c_void, pin: *const c_char, level: c_int) -> c_int;
    fn mb4sim_inject(sim: *mut c_void, text: *const c_char, error: *mut c_char, n: usize) -> c_int;
}

/// What happens to a transfer. `Mosi` and `Miso` flip this bit of the frame. `Left` makes no frame,
/// `Unstored` stores nothing of it, and both report success. `Failed` reports an error. `Miso0`,
/// `Miso1` and `NeverStored` last from this transfer on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    Mosi(usize),
    Miso(usize),
    Left,
    Unstored,
    Failed,
    Miso0,
    Miso1,
    NeverStored,
}

/// The error of the bus that `Fault::Failed` reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BusError;

impl embedded_hal::spi::Error for BusError {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Other
    }
}

/// A simulator. Clones are the same one.
#[derive(Clone)]
pub struct Chip(Rc<Inner>);

struct Inner {
    sim: *mut c_void,
    /// The fault, and the transfers until it comes.
    fault: Cell<Option<(usize, Fault)>>,
    /// Bytes of each transfer since the last disturb() or undisturbed().
    sizes: RefCell<Vec<usize>>,
}

impl Drop for Inner {
    fn drop(&mut self) {
        // SAFETY: opened by Chip::new(), used by nothing else.
        unsafe { mb4sim_close(self.sim) }
    }
}

impl Chip {
    /// A chip with one BiSS C encoder; keys of the encoder and of its channel (sim/README.md).
    pub fn new(encoder: &str, channel: &str) -> Self {
        let text = format!(
            "[host]\nsclk_hz = 5_000_000\n[[channel]]\nnumber = 1\n{channel}\n\
             [[channel.slave]]\nprotocol = \"biss-c\"\n{encoder}\n"
        );
        let text = CString::new(text).unwrap();
        let mut error = [0; 300];
        // SAFETY: a text with its 0, memory for the message.
        let sim = unsafe { mb4sim_open(text.as_ptr(), error.as_mut_ptr(), error.len()) };
        // SAFETY: the message ends with 0.
        assert!(!sim.is_null(), "{:?}", unsafe { CStr::from_ptr(error.as_ptr()) });
        Self(Rc::new(Inner { sim, fault: Cell::new(None), sizes: RefCell::default() }))
    }

    /// Disturbs the transfer number `at` from now on, counted from 0.
    pub fn disturb(&self, at: usize, fault: Fault) {
        self.undisturbed();
        self.0.fault.set(Some((at, fault)));
    }

    /// Ends a fault. The bytes of each transfer since the last such call.
    pub fn undisturbed(&self) -> Vec<usize> {
        self.0.fault.set(None);
        self.0.sizes.take()
    }

    pub fn advance_us(&self, us: u64) {
        // SAFETY: the simulator is open, here and below.
        unsafe { mb4sim_advance_ns(self.0.sim, 1000 * us) }
    }

    pub fn now_us(&self) -> u32 {
        // SAFETY: as above.
        (unsafe { mb4sim_time_ns(self.0.sim) } / 1000) as u32
    }

    /// Frames that the encoder has answered.
    pub fn frames(&self) -> u64 {
        // SAFETY: as above.
        unsafe { mb4sim_slave_frames(self.0.sim, 1) }
    }

    /// Waits until the encoder has answered another frame and the chip has it. False: none comes.
    pub fn next_frame(&self) -> bool {
        let before = self.frames();
        for _ in 0..1000 {
            self.advance_us(2);
            if self.frames() != before {
                self.advance_us(40);
                return true;
            }
        }
        false
    }

    pub fn set_data(&self, raw: u64) {
        // SAFETY: as above.
        assert_eq!(unsafe { mb4sim_slave_set_data(self.0.sim, 1, raw) }, 0);
    }

    pub fn pulse(&self, pin: &CStr) {
        for level in [1, 0] {
            // SAFETY: as above; the name ends with 0.
            assert_eq!(unsafe { mb4sim_pin_write(self.0.sim, pin.as_ptr(), level) }, 0);
            self.advance_us(1);
        }
    }

    /// Adds [[fault]] tables or events of the channel, from now on.
    pub fn inject(&self, text: &str) {
        let text = CString::new(text).unwrap();
        // SAFETY: as above; no memory for a message.
        let code = unsafe { mb4sim_inject(self.0.sim, text.as_ptr(), ptr::null_mut(), 0) };
        assert_eq!(code, 0, "{text:?}");
    }

    /// The cable at the encoder: "unplug" or "plug".
    pub fn cable(&self, action: &str) {
        self.inject(&format!(
            "[[channel]]\nnumber = 1\n[[channel.event]]\nat_us = 0\naction = \"{action}\"\n"
        ));
        self.advance_us(1);
    }

    /// One SPI frame: `bytes` become what the chip answers.
    fn frame(&self, bytes: &mut [u8]) -> Result<bool, BusError> {
        let inner = &*self.0;
        let number = inner.sizes.borrow().len();
        inner.sizes.borrow_mut().push(bytes.len());
        let fault = match inner.fault.get() {
            Some((at, fault)) if at == number => Some(fault),
            Some((at, fault @ (Fault::Miso0 | Fault::Miso1 | Fault::NeverStored)))
                if at < number =>
            {
                Some(fault)
            }
            _ => None,
        };
        match fault {
            Some(Fault::Mosi(bit)) => bytes[bit / 8] ^= 0x80 >> (bit % 8),
            Some(Fault::Left) => return Ok(false),
            _ => {}
        }
        let (at, n) = (bytes.as_mut_ptr(), bytes.len());
        // SAFETY: as above; the simulator reads each byte before it writes it.
        assert_eq!(unsafe { mb4sim_spi_transfer(inner.sim, at as *const u8, at, n) }, 0);
        match fault {
            Some(Fault::Miso(bit)) => bytes[bit / 8] ^= 0x80 >> (bit % 8),
            Some(Fault::Miso0) => bytes.fill(0),
            Some(Fault::Miso1) => bytes.fill(0xFF),
            Some(Fault::Failed) => return Err(BusError),
            _ => {}
        }
        Ok(!matches!(fault, Some(Fault::Unstored | Fault::NeverStored)))
    }
}

impl ErrorType for Chip {
    type Error = BusError;
}

impl SpiDevice for Chip {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), BusError> {
        let mut bytes = Vec::new();
        for operation in operations.iter() {
            match operation {
                Operation::Write(tx) => bytes.extend_from_slice(tx),
                Operation::Transfer(rx, tx) if rx.len() == tx.len() => bytes.extend_from_slice(tx),
                _ => panic!("no such operation is expected"),
            }
        }
        let stored = self.frame(&mut bytes)?;
        let mut back = bytes.as_slice();
        for operation in operations.iter_mut() {
            match operation {
                Operation::Transfer(rx, _) => {
                    let (mine, rest) = back.split_at(rx.len());
                    if stored {
                        rx.copy_from_slice(mine);
                    }
                    back = rest;
                }
                Operation::Write(tx) => back = &back[tx.len()..],
                _ => {}
            }
        }
        Ok(())
    }
}

impl DelayNs for Chip {
    fn delay_ns(&mut self, ns: u32) {
        self.advance_us(u64::from(ns) / 1000 + 1);
    }
}

/// A ramp of 28 bits at 2.5 MHz, a frame each 500 us.
pub const CONFIG: Config = Config {
    f_clk_hz: 20_000_000,
    max_ma_hz: 2_500_000,
    frame_period_ns: 500_000,
    crc_polynomial: 0x43,
    crc_start: 0,
    data_bits: 28,
    spi_check: SpiCheck::Full,
    error_warning: true,
    internal_clock: false,
    on_pin: false,
};

pub type Answer = Result<Reading, Error<BusError>>;

/// A chip whose encoder turns: its frame n, from 1 on, has START + (n - 1) STEP.
pub struct Drive {
    pub chip: Chip,
    pub encoder: Encoder<Chip>,
}

pub const START: u64 = 1000;
pub const STEP: u64 = 3;

impl Drive {
    /// `encoder`, `channel`: keys of the scenario besides.
    pub fn new(config: &Config, encoder: &str) -> Self {
        Self::on_channel(config, encoder, "")
    }

    pub fn on_channel(config: &Config, encoder: &str, channel: &str) -> Self {
        let Config { data_bits, crc_polynomial, crc_start, .. } = *config;
        let flag_bits = if config.error_warning { 2 } else { 0 };
        let keys = format!(
            "data_bits = {data_bits}\nflag_bits = {flag_bits}\ncrc = {crc_polynomial}\n\
             crc_start = {crc_start}\nsource = \"ramp\"\nstart = {START}\nstep = {STEP}\n{encoder}"
        );
        let chip = Chip::new(&keys, channel);
        let mut encoder = Encoder::new(chip.clone(), config).unwrap();
        encoder.start(&mut chip.clone()).unwrap();
        let mut new = Self { chip, encoder };
        assert_eq!(new.read(), Err(Error::NoData), "the first read drops words");
        new
    }

    pub fn read(&mut self) -> Answer {
        self.encoder.read(self.chip.now_us())
    }

    /// What a read brings of the next frame.
    pub fn next(&mut self) -> Answer {
        assert!(self.chip.next_frame(), "no frame comes");
        self.read()
    }

    /// Position of the encoder's last frame.
    pub fn expected(&self) -> u64 {
        START + STEP * (self.chip.frames() - 1)
    }

    /// Does what README.md says until a position comes. It is that of the last frame.
    pub fn recover(&mut self) {
        for _ in 0..40 {
            let came = self.chip.next_frame();
            match self.read() {
                Ok(reading) => {
                    return assert!(came && reading.position == self.expected(), "{reading:?}")
                }
                Err(Error::NoData | Error::Crc) => {}
                Err(Error::Corrupted | Error::NotDetected) if self.encoder.verify().is_ok() => {}
                Err(_) => self.encoder.start(&mut self.chip.clone()).unwrap(),
            }
        }
        panic!("no position comes again");
    }
}
