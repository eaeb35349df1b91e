// SPDX-License-Identifier: MIT
//! Two octahedra: the upper moves down into the lower, and both become one. As minimal.c.
use topoadapt::{Config, Context, Result};

const AT: [[f32; 3]; 12] = [
    [3., 0., 0.],
    [0., 3., 0.],
    [-3., 0., 0.],
    [0., -3., 0.],
    [0., 0., 3.],
    [0., 0., -3.],
    [3., 0., 7.],
    [0., 3., 7.],
    [-3., 0., 7.],
    [0., -3., 7.],
    [0., 0., 10.],
    [0., 0., 4.],
];
const LOWER: [[u16; 3]; 8] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];

fn main() -> Result<()> {
    let upper: Vec<[u16; 3]> = LOWER.iter().map(|&[a, b, c]| [a + 6, b + 6, c + 6]).collect();
    let down: Vec<[f32; 3]> = AT[6..].iter().map(|&[x, y, z]| [x, y, z - 2.]).collect();

    let mut context = Context::new(&Config::new().max_vertices(100))?;
    context.load(&AT, &[&LOWER, &upper[..]].concat())?;
    context.move_vertices(&[6, 7, 8, 9, 10, 11], &down)?;
    let report = context.step(None)?;
    println!(
        "{} contacts, volume {:.4}, {} vertices kept back",
        report.contacts, report.region_after, report.rolled_back_vertices
    );
    println!("{} vertices, {} triangles", report.vertices, report.triangles);
    Ok(())
}
