//! Every example ends well; each asserts what it shows.

macro_rules! run {
    ($($example:ident: $path:literal;)*) => {
        $(#[path = $path]
        mod $example;

        #[test]
        fn $example() -> Result<(), Box<dyn std::error::Error>> {
            $example::main()
        })*

        const RUN: &[&str] = &[$($path),*];
    };
}

run! {
    cancel: "../examples/cancel.rs";
    concrete: "../examples/concrete.rs";
    foreign_gcode: "../examples/foreign_gcode.rs";
    obstacle_course: "../examples/obstacle_course.rs";
    overhangs: "../examples/overhangs.rs";
    own_layers: "../examples/own_layers.rs";
    tour_solver: "../examples/tour_solver.rs";
}

#[test]
fn no_example_is_left_out() -> std::io::Result<()> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for entry in std::fs::read_dir(folder)? {
        let name = entry?.file_name().into_string().unwrap_or_default();
        assert!(RUN.contains(&format!("../examples/{name}").as_str()), "{name} is not run here");
    }
    Ok(())
}
