/// Reads the bytes as g-code: moves that are finite, in the order of their lines, whatever the text.
pub fn read_gcode(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let program = argil_gcode::read_gcode(&text);
    let mut line = 0;
    for step in &program.moves {
        let values = step.from.iter().chain(&step.to).chain([&step.extruded]);
        assert!(values.into_iter().all(|value| value.is_finite()), "{step:?} is not finite");
        assert!(step.line >= line, "{step:?} comes after line {line}");
        line = step.line;
        assert!(step.kind.is_none() || program.kind_of(step).is_some(), "{step:?} is of no kind");
    }
    // A line ends at \n, \r or both; lines that are read are no more than that.
    let lines = 1 + text.matches(['\n', '\r']).count();
    let last_bad = program.bad_lines.iter().map(|bad| bad.line).max();
    assert!(line.max(last_bad.unwrap_or(0)) <= lines, "there are only {lines} lines");
    let strand = program.strand_moves();
    assert!(strand.first().is_none_or(|step| step.extruded > 0.0));
    assert!(strand.last().is_none_or(|step| step.extruded > 0.0));
}
