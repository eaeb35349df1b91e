// SPDX-License-Identifier: MIT
// Meshes for tests and for the examples in the documentation.

/// A context with an octahedron.
pub fn octahedron() -> topoadapt::Result<topoadapt::Context<'static>> {
    let positions: [[f32; 3]; 6] =
        [[3., 0., 0.], [0., 3., 0.], [-3., 0., 0.], [0., -3., 0.], [0., 0., 3.], [0., 0., -3.]];
    let triangles: [[u16; 3]; 8] =
        [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
    let mut context = topoadapt::Context::new(&topoadapt::Config::new().max_vertices(100))?;
    context.load(&positions, &triangles)?;
    Ok(context)
}

/// Vertices and triangles of balls round the centres.
pub fn balls(centres: &[[f64; 3]], radius: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for centre in centres {
        add_ball(*centre, radius, &mut positions, &mut triangles);
    }
    (positions, triangles)
}

const RINGS: u32 = 12;
const SECTORS: u32 = 24;

/// Number of vertices of a ball.
pub const BALL: u32 = RINGS * SECTORS + 2;

/// Adds rings of vertices between two poles.
fn add_ball(centre: [f64; 3], radius: f64, positions: &mut Vec<[f64; 3]>, triangles: &mut Vec<[u32; 3]>) {
    let base = positions.len() as u32;
    let (north, south) = (base + RINGS * SECTORS, base + RINGS * SECTORS + 1);
    let mut add = |x: f64, y: f64, z: f64| {
        positions.push([centre[0] + radius * x, centre[1] + radius * y, centre[2] + radius * z]);
    };
    for ring in 0..RINGS {
        let polar = std::f64::consts::PI * f64::from(ring + 1) / f64::from(RINGS + 1);
        for sector in 0..SECTORS {
            let around = 2. * std::f64::consts::PI * f64::from(sector) / f64::from(SECTORS);
            add(polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos());
        }
    }
    add(0., 0., 1.);
    add(0., 0., -1.);
    for s in 0..SECTORS {
        let t = (s + 1) % SECTORS;
        let last = base + (RINGS - 1) * SECTORS;
        triangles.push([north, base + s, base + t]);
        triangles.push([south, last + t, last + s]);
        for ring in 0..RINGS - 1 {
            let upper = base + ring * SECTORS;
            let lower = upper + SECTORS;
            triangles.push([upper + s, lower + s, lower + t]);
            triangles.push([upper + s, lower + t, upper + t]);
        }
    }
}
