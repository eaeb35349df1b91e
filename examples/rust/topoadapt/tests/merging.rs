// SPDX-License-Identifier: MIT
//! Whole tasks through the safe interface.
#[allow(dead_code)]
mod support;
use std::slice::from_ref;
use std::sync::atomic::{AtomicI32, AtomicU64, Ordering};
use std::thread;
use support::{balls, octahedron, BALL};
use topoadapt::*;

const APART: [[f64; 3]; 2] = [[-1.3, 0., 0.], [1.3, 0.1, 0.]];

fn context_of(centres: &[[f64; 3]], radius: f64, config: &Config) -> Result<Context<'static>> {
    let (positions, triangles) = balls(centres, radius);
    let mut context = Context::new(config)?;
    context.load(&positions, &triangles)?;
    Ok(context)
}

fn plenty() -> Config {
    Config::new().max_vertices(8 * BALL)
}

/// Wants the two balls nearer to each other.
fn approach(context: &mut Context<'_>) -> Result<()> {
    let to_the_right = |id| if id < BALL as usize { 0.25 } else { -0.25 };
    let positions = context.mesh()?.positions;
    let nearer: Vec<_> = positions.iter().enumerate().map(|(id, &[x, y, z])| [x + to_the_right(id), y, z]).collect();
    context.move_all(&nearer)
}

/// Two steps, the second with contacts.
fn merge(context: &mut Context<'_>, exec: Option<&Exec<'_>>) -> Result<Report> {
    approach(context)?;
    assert_eq!(context.step(exec)?.contacts, 0);
    approach(context)?;
    context.step(exec)
}

#[test]
fn two_balls_merge() -> Result<()> {
    let mut context = context_of(&APART, 1., &plenty())?;
    let before = context.components()?;
    assert_eq!(before.iter().map(|ball| ball.id).collect::<Vec<_>>(), [0, BALL]);
    assert!(before.iter().all(|ball| ball.genus == 0 && ball.vertices == BALL));
    assert_eq!(before.of_vertex(BALL + 1), Some(&before.as_slice()[1]));
    assert_eq!(before.of_vertex(2 * BALL), None);
    let precise: Vec<[f64; 1]> = context.mesh()?.positions.iter().map(|p| [p[2]]).collect();
    let heights: Vec<[f32; 1]> = precise.iter().map(|z| [z[0] as f32]).collect();

    let report = merge(&mut context, None)?;
    assert!(report.contacts > 0);
    assert!(context.rolled_back().is_empty());
    let merges: Vec<Event> = context.events().filter(|event| matches!(event, Event::Merge { .. })).collect();
    assert_eq!(merges, [Event::Merge { components: 2, before: 0, after: 0 }]);
    assert_eq!(context.events().rev().count(), context.events().len());
    let after = context.components()?;
    assert_eq!((after.len(), after.iter().next().map(|one| one.genus)), (1, Some(0)));

    // The balls came nearer along x: heights are as before, but near the seam.
    let carried = context.carry_vertices(&heights)?;
    let carried_precisely = context.carry_vertices_f64(&precise)?;
    assert!(carried
        .iter()
        .zip(&carried_precisely)
        .all(|(single, double)| (f64::from(single[0]) - double[0]).abs() < 1e-6));
    let map = context.vertex_map()?;
    assert_eq!((map.old_count(), map.new_count()), (heights.len(), carried.len()));
    let mesh = context.mesh()?;
    let mut kept = 0;
    for (new, origin) in map.origins().enumerate() {
        if let Origin::Old(old) = origin {
            assert_eq!(map.new_id(old), Some(new as u32));
            assert_eq!(carried[new], heights[old as usize]);
            assert_eq!(carried_precisely[new], precise[old as usize]);
            kept += usize::from(mesh.positions[new][2] as f32 == carried[new][0]);
        }
    }
    assert!(kept > BALL as usize);
    let marks: Vec<[f32; 2]> = (0..context.triangle_map()?.old_count()).map(|t| [t as f32, 1.]).collect();
    let marked = context.carry_triangles(&marks)?;
    for (mark, origin) in marked.iter().zip(context.triangle_map()?.origins()) {
        assert!(origin.map_or(mark[1] == 1., |old| *mark == marks[old as usize]));
    }
    assert_eq!(context.carry_triangles(&marks[1..]).unwrap_err().status(), Status::Argument);
    Ok(())
}

#[test]
fn a_tangle_adapts() -> Result<()> {
    let mut context = context_of(&[[-1.5, 0., 0.], [1.5, 0., 0.], [0., 2.5, 0.]], 2., &plenty())?;
    let before = context.validate(None)?;
    assert_eq!(before.components, 3);
    let contacts = context.detect(None)?;
    assert_eq!(contacts.pairs().len() as u64, before.self_intersections);
    let last = contacts.mesh().triangles.len() as u32;
    assert!(contacts.pairs().iter().all(|&[a, b]| a < b && b < last));
    assert_eq!(context.step(None).unwrap_err().status(), Status::Tangled);

    let report = context.adapt(None)?;
    assert_eq!((report.unresolved, report.vertices as usize), (0, context.mesh()?.positions.len()));
    let after = context.validate(None)?;
    assert_eq!((after.components, after.self_intersections, after.genus, after.euler), (1, 0, 0, 2));
    assert!((after.volume - report.region_after).abs() < 1e-9 * after.volume);
    assert!(context.detect(None)?.pairs().is_empty());

    let report = context.remesh(&Remesh::to_length(0.5).iterations(2).ratios(1.5, 0.8).relaxation(0.5), None)?;
    assert!(report.splits + report.collapses + report.flips > 0);
    assert!(context.smooth(2, None, None)?.moved > 0);
    assert_eq!(context.smooth(2, Some(&[]), None)?.moved, 0);
    assert_eq!(context.smooth(2, Some(&[1 << 20]), None).unwrap_err().defect(), Some(Defect::IndexRange));

    let before = context.mesh()?.positions.to_vec();
    context.reorder()?;
    assert_ne!(context.mesh()?.positions, before);
    assert_eq!(context.carry_vertices_f64(&before)?, context.mesh()?.positions);
    Ok(())
}

#[test]
fn remeshing_keeps_to_a_part_and_to_lengths() -> Result<()> {
    let mut context = context_of(&APART, 1., &plenty())?;
    let before = context.mesh()?.positions.to_vec();
    let left: Vec<u32> = (0..BALL).collect();
    context.remesh(&Remesh::to_length(0.1).part(&left).iterations(2), None)?;
    let map = context.vertex_map()?;
    assert!((BALL..2 * BALL).all(|old| {
        let new = map.new_id(old).expect("the right ball keeps its vertices") as usize;
        context.mesh().unwrap().positions[new] == before[old as usize]
    }));
    assert!(context.components()?.as_slice()[0].vertices > 2 * BALL);

    // Half the length means four times the vertices.
    let lengths: Vec<f32> = context.mesh()?.positions.iter().map(|p| if p[0] < 0. { 0.4 } else { 0.2 }).collect();
    context.with_room(|context| context.remesh(&Remesh::to_lengths(&lengths).iterations(8), None))?;
    let components = context.components()?;
    let [coarse, fine] = [-1., 1.].map(|side| {
        let id = context.mesh().unwrap().positions.iter().position(|p| side * p[0] > 0.5).unwrap();
        f64::from(components.of_vertex(id as u32).unwrap().vertices)
    });
    assert!((3. ..5.).contains(&(fine / coarse)), "{coarse} {fine}");

    let error = context.remesh(&Remesh::to_lengths(&lengths), None).unwrap_err();
    assert_eq!(error.to_string(), "a length is needed for each vertex of the mesh");
    assert_eq!(context.remesh(&Remesh::to_length(0.1).part(&[]), None)?.splits, 0);
    let error = context.remesh(&Remesh::to_length(0.1).part(&[u32::MAX - 1]), None).unwrap_err();
    assert_eq!(error.defect(), Some(Defect::IndexRange));
    Ok(())
}

#[test]
fn targets_of_another_mesh_are_refused() -> Result<()> {
    let mut context = context_of(&APART, 1., &plenty())?;
    let stale = context.mesh()?.positions.to_vec();
    let all = [stale.clone(), stale.clone()].concat();
    for wrong in [&stale[1..], &all[..], &[]] {
        let error = context.move_all(wrong).unwrap_err();
        assert_eq!(error.to_string(), "a target is needed for each vertex of the mesh");
        assert!(context.targets().is_empty());
    }
    context.move_all(&stale)?;
    assert_eq!(context.targets().len(), stale.len());
    let mut empty = Context::new(&plenty())?;
    assert_eq!(empty.move_all(&stale).unwrap_err().status(), Status::NoMesh);
    Ok(())
}

#[test]
fn balls_that_would_pass_each_other_meet_in_substeps() -> Result<()> {
    let jump = |context: &mut Context<'_>| {
        let positions = context.mesh()?.positions;
        let across = |id| if id < BALL as usize { 2.6 } else { -2.6 };
        let targets: Vec<_> = positions.iter().enumerate().map(|(id, &[x, y, z])| [x + across(id), y, z]).collect();
        context.move_all(&targets)
    };
    let mut unseen = context_of(&APART, 1., &plenty())?;
    jump(&mut unseen)?;
    let report = unseen.step(None)?;
    assert_eq!((report.contacts, report.substeps), (0, 0));
    assert_eq!(unseen.components()?.len(), 2);

    let mut context = context_of(&APART, 1., &plenty())?;
    jump(&mut context)?;
    let error = context.advance(0.5, None).unwrap_err();
    assert_eq!(error.limit(), Some(Limit::Substeps));
    let report = context.with_room(|context| context.advance(0.5, None))?;
    assert!(report.contacts > 0 && u64::from(report.substeps) >= error.needed());
    assert!(context.events().any(|event| matches!(event, Event::Merge { components: 2, .. })));
    Ok(())
}

#[test]
fn changes_bring_a_copy_up_to_date() -> Result<()> {
    let mut context = context_of(&APART, 1., &plenty())?;
    let mut copy = context.mesh()?.positions.to_vec();
    let everything = context.changes(0, u32::MAX)?;
    assert_eq!(everything.vertices, from_ref(&(0..2 * BALL)));
    merge(&mut context, None)?;
    copy.clear();
    copy.extend(context.mesh()?.positions);
    context.move_vertices(&[7, 3], &[copy[7].map(|x| x * 1.001), copy[3].map(|x| x * 1.001)])?;
    assert_eq!(context.targets().iter().map(|target| target.0).collect::<Vec<_>>(), [3, 7]);
    context.step(None)?;
    let changes = context.changes(0, 100)?;
    assert_eq!((&changes.vertices[..], &changes.triangles[..]), (&[3..4, 7..8][..], &[][..]));
    assert_eq!(context.changes(3, 100)?.vertices, from_ref(&(3..8)));
    assert_eq!(context.changes(0, 1)?.vertices, from_ref(&(3..8)));
    for range in changes.vertices {
        let range = range.start as usize..range.end as usize;
        copy[range.clone()].copy_from_slice(&context.mesh()?.positions[range]);
    }
    assert_eq!(copy, context.mesh()?.positions);
    Ok(())
}

#[test]
fn states_go_round() -> Result<()> {
    let mut context = context_of(&APART, 1., &plenty())?;
    approach(&mut context)?;
    let start = context.save()?;
    let snapshot = context.clone();
    context.step(None)?;
    assert_ne!(context.digest(), snapshot.digest());
    let end = context.digest();

    let mut other = Context::new(&plenty().max_contacts(5000))?;
    other.restore(&start)?;
    assert_eq!(other.digest(), snapshot.digest());
    other.step(None)?;
    assert_eq!(other.digest(), end);
    context.clone_from(&snapshot);
    assert_eq!(context.save()?, start);
    context.step(None)?;
    assert_eq!(context.digest(), end);

    let mut damaged = start.clone();
    damaged[start.len() / 2] ^= 1;
    assert_eq!(context.restore(&damaged).unwrap_err().status(), Status::Data);
    assert_eq!(context.restore(&[]).unwrap_err().status(), Status::Data);
    let mut unlike = Context::new(&plenty().region(Region::Outside))?;
    assert_eq!(unlike.restore(&start).unwrap_err().status(), Status::Config);
    assert_eq!(context.digest(), end);
    context.drop_targets();
    context.reset();
    assert_eq!(context.mesh().unwrap_err().status(), Status::NoMesh);
    Ok(())
}

#[test]
fn limits_grow() -> Result<()> {
    let mut with_plenty = context_of(&APART, 1., &plenty())?;
    merge(&mut with_plenty, None)?;
    let little = Config::new().max_vertices(2 * BALL).max_contacts(1).max_cut_edges(3).max_events(1);
    let mut context = context_of(&APART, 1., &little)?;
    let error = merge(&mut context, None).unwrap_err();
    assert_eq!((error.status(), error.limit()), (Status::Limit, Some(Limit::Contacts)));
    assert!(error.needed() > error.available());
    assert_ne!(context.digest(), with_plenty.digest());

    context.with_room(|context| context.step(None))?;
    assert_eq!(context.digest(), with_plenty.digest());
    assert_ne!(context.config()?, little);
    assert!(context.memory().iter().any(|table| table.peak > 1));

    let mut arena = Arena::new(&plenty())?;
    let lent = context.grow_in(&mut arena, &plenty())?;
    drop(context);
    assert_eq!(lent.digest(), with_plenty.digest());
    assert_eq!(lent.clone().digest(), with_plenty.digest());
    assert_eq!(lent.grow(&little).unwrap_err().status(), Status::Limit);
    Ok(())
}

#[test]
fn errors_name_the_element() -> Result<()> {
    let mut context = octahedron()?;
    let (positions, mut triangles) = context.export::<f32, u16>()?;
    triangles[5] = [2, 1, 9];
    let error = context.load(&positions, &triangles).unwrap_err();
    assert_eq!((error.status(), error.defect()), (Status::Mesh, Some(Defect::IndexRange)));
    assert_eq!((error.element(), error.other(), error.available()), (5, 9, 6));
    assert!(error.to_string().ends_with("triangle 5 names vertex 9 of 6 vertices"), "{error}");
    triangles.pop();
    triangles[5] = [2, 1, 5];
    let error = context.load(&positions, &triangles).unwrap_err();
    assert_eq!(error.defect(), Some(Defect::BoundaryEdge));

    let error = context.move_vertices(&[0], &[[f64::NAN, 0., 0.]]).unwrap_err();
    assert_eq!((error.defect(), error.element()), (Some(Defect::NotFinite), 0));
    let error = context.move_vertices(&[0, 1], &[[0f32; 3]]).unwrap_err();
    assert_eq!((error.status(), error.to_string().as_str()), (Status::Argument, "a target is needed for each vertex"));
    let error = Context::new(&Config::new().max_passes(65)).unwrap_err();
    assert_eq!(error.status(), Status::Config);
    assert!(error.to_string().contains("max_passes"), "{error}");

    let config = Config::new().max_vertices(100);
    let size = config.arena_size()?;
    let mut arena = Arena::new(&config)?;
    let error = Context::new_in(&mut arena[..size.bytes - 1], &config).unwrap_err();
    assert_eq!((error.status(), error.needed()), (Status::Arena, size.bytes as u64));
    let boxed: Box<dyn std::error::Error + Send + Sync> = Box::new(error);
    assert!(!boxed.to_string().is_empty());
    Ok(())
}

#[test]
fn threads_change_no_bit() -> Result<()> {
    let row: Vec<[f64; 3]> = (0..30).map(|i| [1.5 * f64::from(i), 0.02 * f64::from(i * i % 7), 0.]).collect();
    let config = Config::new().max_vertices(60 * BALL);
    let mut serial = context_of(&row, 1., &config)?;
    assert_eq!(serial.adapt(None)?.unresolved, 0);
    for threads in [2, 3, 7] {
        let mut context = context_of(&row, 1., &config)?;
        context.adapt(Some(&Exec::new().threads(threads)))?;
        assert_eq!(context.digest(), serial.digest(), "{threads} threads");
    }
    Ok(())
}

#[test]
fn bounds_hold_and_change_no_bit() -> Result<()> {
    let (stop, units) = (AtomicI32::new(0), AtomicU64::new(0));
    let mut free = context_of(&APART, 1., &plenty())?;
    merge(&mut free, None)?;
    let mut context = context_of(&APART, 1., &plenty())?;
    merge(&mut context, Some(&Exec::new().budget(1 << 40).cancel(&stop).progress(&units)))?;
    assert_eq!(context.digest(), free.digest());
    assert!(units.load(Ordering::Relaxed) > 0);

    let mut context = context_of(&APART, 1., &plenty())?;
    approach(&mut context)?;
    let before = context.digest();
    assert_eq!(context.step(Some(&Exec::new().budget(1))).unwrap_err().status(), Status::Budget);
    stop.store(1, Ordering::Relaxed);
    assert_eq!(context.step(Some(&Exec::new().cancel(&stop))).unwrap_err().status(), Status::Cancelled);
    assert_eq!(context.digest(), before);
    Ok(())
}

#[test]
fn contexts_travel_and_are_shared() -> Result<()> {
    let mut context = context_of(&APART, 1., &plenty())?;
    let digest = context.digest();
    thread::scope(|scope| {
        let readers: Vec<_> = (0..3).map(|_| scope.spawn(|| (context.digest(), context.components()))).collect();
        for reader in readers {
            let (seen, components) = reader.join().unwrap();
            assert_eq!((seen, components.unwrap().len()), (digest, 2));
        }
    });
    let mut context = thread::spawn(move || merge(&mut context, None).map(|_| context)).join().unwrap()?;
    assert_eq!(context.validate(None)?.components, 1);
    Ok(())
}

#[test]
fn handles_join_their_polygons() -> Result<()> {
    let sides = [3, 4, 5];
    let info = handles::describe(&sides)?;
    assert_eq!(info.faces, 3 + 4 + 5 + 2 * 3 - 4);
    let faces = handles::get(&sides, info.handles - 1)?;
    assert_eq!(faces.len(), info.faces as usize);
    let has_edge = |from, to| faces.iter().any(|f| (0..3).any(|i| (f[i], f[(i + 1) % 3]) == (from, to)));
    assert!([(0, 1), (1, 2), (2, 0), (3, 4), (6, 3), (7, 8), (11, 7)].iter().all(|&(from, to)| has_edge(from, to)));
    let mut total = 0;
    for index in 0..info.generators {
        total += handles::generator(&sides, index)?.1;
    }
    assert_eq!(total, info.handles);
    assert_eq!(handles::get(&sides, info.handles).unwrap_err().status(), Status::Argument);
    assert_eq!(handles::describe(&[]).unwrap_err().status(), Status::Argument);
    assert_eq!(handles::describe(&[3, 16]).unwrap_err().status(), Status::Argument);
    Ok(())
}

#[test]
fn the_version_is_that_of_the_library() {
    let (major, minor, patch) = version();
    assert!(build_info().contains(&format!("{major}.{minor}.{patch}")), "{}", build_info());
}
