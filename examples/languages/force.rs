// SPDX-License-Identifier: BSD-3-Clause
// The C interface from Rust: rustc force.rs -l forceshade && ./force
use std::ffi::{CStr, CString};
use std::os::raw::c_char;

#[repr(C)]
struct Law { size: usize, radius: f32, width: f32, stiffness: f32 }
#[repr(C)]
#[derive(Clone, Copy, Default)]
struct Subject { handle: u64 }

extern "C" {
    fn forceshade_message() -> *const c_char;
    fn forceshade_law_new(law: *const c_char, parameters: *const Law, made: *mut Subject) -> i32;
    fn forceshade_force(subject: Subject, position: *const f32, force: *mut f32, status: *mut u8) -> i32;
}

fn checked(result: i32) -> Result<(), String> {
    if result == 0 { return Ok(()); }
    Err(unsafe { CStr::from_ptr(forceshade_message()) }.to_string_lossy().into_owned())
}

fn main() -> Result<(), String> {
    let law = Law { size: std::mem::size_of::<Law>(), radius: 15.24, width: 25.4, stiffness: 0.5 };
    let (name, mut bump) = (CString::new("bump-2p").unwrap(), Subject::default());
    checked(unsafe { forceshade_law_new(name.as_ptr(), &law, &mut bump) })?;
    let (position, mut force) = ([3.0f32, 0.0, -0.5], [0.0f32; 3]); // mm, N
    checked(unsafe { forceshade_force(bump, position.as_ptr(), force.as_mut_ptr(), std::ptr::null_mut()) })?;
    println!("{} N", force[2]);
    Ok(())
}
