// SPDX-License-Identifier: MIT
//! Two octahedra: the upper moves down into the lower, and both become one. As minimal.c, from Rust, with a
//! block that the allocator of Rust hands out. docs/guide.md says how to build it (Link).
use std::alloc::{alloc, dealloc, Layout};
use std::ffi::CStr;
use std::mem::{size_of, zeroed};
use std::ptr::{null, null_mut};

/// What bindgen makes of topoadapt.h.
#[allow(warnings)]
mod ffi {
    include!(env!("TOPOADAPT_BINDINGS"));
}
use ffi::*;

const POSITIONS: [f32; 36] = [
    3., 0., 0., 0., 3., 0., -3., 0., 0., 0., -3., 0., 0., 0., 3., 0., 0., -3., //
    3., 0., 7., 0., 3., 7., -3., 0., 7., 0., -3., 7., 0., 0., 10., 0., 0., 4.,
];
const TRIANGLES: [u16; 48] = [
    0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5, //
    6, 7, 10, 7, 8, 10, 8, 9, 10, 9, 6, 10, 7, 6, 11, 8, 7, 11, 9, 8, 11, 6, 9, 11,
];
const UPPER: [u32; 6] = [6, 7, 8, 9, 10, 11];
const TO: [f32; 18] = [3., 0., 5., 0., 3., 5., -3., 0., 5., 0., -3., 5., 0., 0., 8., 0., 0., 2.];

/// What the field struct_size of an interface struct has to hold.
fn struct_size<T>() -> u32 {
    size_of::<T>() as u32
}

/// A context in a block of its own.
struct Adapter {
    block: *mut u8,
    layout: Layout,
    context: *mut tpa_context,
}

type Outcome = Result<(), String>;

/// Makes a result of what a call returns.
fn outcome(status: tpa_status, issue: &tpa_issue) -> Outcome {
    if status == TPA_OK as tpa_status {
        return Ok(());
    }
    let mut text = [0; 256];
    unsafe {
        if issue.status == TPA_OK as tpa_status {
            return Err(CStr::from_ptr(tpa_status_string(status)).to_string_lossy().into_owned());
        }
        tpa_issue_text(issue, text.as_mut_ptr(), text.len() as _);
        Err(CStr::from_ptr(text.as_ptr()).to_string_lossy().into_owned())
    }
}

impl Adapter {
    fn new(max_vertices: u32) -> Result<Adapter, String> {
        unsafe {
            let mut issue: tpa_issue = zeroed();
            let mut config: tpa_config = zeroed();
            outcome(tpa_config_init(&mut config, size_of::<tpa_config>() as _), &issue)?;
            config.max_vertices = max_vertices;
            let mut size: tpa_arena_size = zeroed();
            outcome(tpa_arena_query(&config, &mut size, &mut issue), &issue)?;
            let layout = Layout::from_size_align(size.bytes as usize, size.alignment as usize)
                .map_err(|e| e.to_string())?;
            let block = alloc(layout);
            if block.is_null() {
                return Err(format!("no block of {} bytes", layout.size()));
            }
            let mut adapter = Adapter { block, layout, context: null_mut() };
            let status = tpa_init(block.cast(), size.bytes, &config, &mut adapter.context, &mut issue);
            outcome(status, &issue)?;
            Ok(adapter)
        }
    }

    fn load(&mut self, positions: &[f32], triangles: &[u16]) -> Outcome {
        unsafe {
            let mut issue: tpa_issue = zeroed();
            let mut mesh: tpa_mesh_input = zeroed();
            mesh.struct_size = struct_size::<tpa_mesh_input>();
            mesh.vertex_count = (positions.len() / 3) as u32;
            mesh.triangle_count = (triangles.len() / 3) as u32;
            mesh.position_type = TPA_FLOAT32 as _;
            mesh.index_type = TPA_UINT16 as _;
            mesh.positions = positions.as_ptr().cast();
            mesh.triangles = triangles.as_ptr().cast();
            outcome(tpa_load(self.context, &mesh, &mut issue), &issue)
        }
    }

    fn move_vertices(&mut self, vertices: &[u32], to: &[f32]) -> Outcome {
        assert_eq!(to.len(), 3 * vertices.len());
        unsafe {
            let mut issue: tpa_issue = zeroed();
            let mut targets: tpa_move_input = zeroed();
            targets.struct_size = struct_size::<tpa_move_input>();
            targets.count = vertices.len() as u32;
            targets.position_type = TPA_FLOAT32 as _;
            targets.positions = to.as_ptr().cast();
            targets.vertices = vertices.as_ptr();
            outcome(tpa_move(self.context, &targets, &mut issue), &issue)
        }
    }

    fn step(&mut self) -> Result<tpa_report, String> {
        unsafe {
            let mut issue: tpa_issue = zeroed();
            let mut report: tpa_report = zeroed();
            report.struct_size = struct_size::<tpa_report>();
            outcome(tpa_step(self.context, null(), &mut report, &mut issue), &issue)?;
            Ok(report)
        }
    }
}

impl Drop for Adapter {
    fn drop(&mut self) {
        unsafe { dealloc(self.block, self.layout) }
    }
}

fn main() -> Outcome {
    let mut adapter = Adapter::new(100)?;
    adapter.load(&POSITIONS, &TRIANGLES)?;
    adapter.move_vertices(&UPPER, &TO)?;
    let report = adapter.step()?;
    println!(
        "{} contacts, volume {:.4}, {} vertices kept back",
        report.contacts, report.region_after, report.rolled_back_vertices
    );
    println!("{} vertices, {} triangles", report.vertices, report.triangles);
    if report.rolled_back_vertices == 0 { Ok(()) } else { Err("they have not become one".into()) }
}
