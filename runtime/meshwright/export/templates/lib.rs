//! Tooth contact of one gear drive: @said@.
//!
//! Angles are those of the pinion, rad, of any size to 1e12 to either side; a result has the same bits whatever was asked
//! before. What does not exist is not a number.

use std::ffi::CStr;
use std::os::raw::{c_char, c_int};

extern "C" {
    fn mesh_length() -> usize;
    fn mesh_begin(m: *mut f64) -> c_int;
    fn mesh_follow(m: *mut f64, phi: f64, row: *mut f64) -> c_int;
    fn mesh_cycle(m: *mut f64, phi: f64, row: *mut f64) -> c_int;
    fn mesh_status_word(status: c_int) -> *const c_char;
}

/// The drive, and what it keeps of the contact before.
pub struct Mesh {
    state: Vec<f64>,
}

/// The tooth pair whose reference angle is the nearest: its number, its own angle, its transmission error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    pub pair: f64,
    pub angle: f64,
    pub error: f64,
    pub status: &'static str,
}

/// One flank of the drive: the pair that leads, its error in the angles of the driving flank, d(wheel)/d(pinion angle), how many
/// pairs touch within their limits, and whether an edge may touch before them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    pub pair: f64,
    pub error: f64,
    pub ratio: f64,
    pub status: &'static str,
    pub pairs: u32,
    pub edge: bool,
}

/// The whole drive, and how far the wheel is free between both flanks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    pub pair: f64,
    pub angle: f64,
    pub backlash: f64,
    pub drive: Side,
    pub coast: Side,
}

fn word(status: f64) -> &'static str {
    unsafe { CStr::from_ptr(mesh_status_word(status as c_int)) }.to_str().unwrap_or("unknown")
}

fn side(row: &[f64]) -> Side {
    Side { pair: row[0], error: row[1], ratio: row[2], status: word(row[3]), pairs: row[4] as u32, edge: row[5] != 0.0 }
}

impl Mesh {
    pub fn new() -> Mesh {
        let mut state = vec![0.0; unsafe { mesh_length() }];
        let guard = unsafe { mesh_begin(state.as_mut_ptr()) };
        assert_eq!(guard, 0, "the design was checked before it was written");
        Mesh { state }
    }

    pub fn follow(&mut self, phi: f64) -> Contact {
        let mut row = [0.0; 4];
        unsafe { mesh_follow(self.state.as_mut_ptr(), phi, row.as_mut_ptr()) };
        Contact { pair: row[0], angle: row[1], error: row[2], status: word(row[3]) }
    }

    pub fn cycle(&mut self, phi: f64) -> Cycle {
        let mut row = [0.0; 15];
        unsafe { mesh_cycle(self.state.as_mut_ptr(), phi, row.as_mut_ptr()) };
        Cycle { pair: row[0], angle: row[1], backlash: row[2], drive: side(&row[3..9]), coast: side(&row[9..15]) }
    }
}

impl Default for Mesh {
    fn default() -> Mesh {
        Mesh::new()
    }
}
