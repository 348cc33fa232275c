//! Options from a file, and options as a file.
//!
//! A file's keys are the long names of options. They are put before the options of the command line as if they had been
//! typed there, so that every option can stand in a file and is checked as usual; what is typed wins.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use clap::{Arg, ArgMatches, Command};
use toml::{Table, Value};

use crate::failure::Failure;

/// Options that make no sense in a file.
const TYPED_ONLY: [&str; 4] = ["config", "print-config", "help", "version"];

/// The command line with the options of its file, if it names one.
pub(crate) fn with_file(command: &Command, typed: Vec<OsString>) -> Result<Vec<OsString>, Failure> {
    let Some(file) = named_file(&typed) else { return Ok(typed) };
    let known = typed.get(1).and_then(|name| command.find_subcommand(name));
    let Some(known) = known else { return Ok(typed) };
    let path = Path::new(&file);
    let text = fs::read_to_string(path).map_err(|source| Failure::reading(path, source))?;
    let table: Table = toml::from_str(&text).map_err(|source| Failure::input(&file, source))?;
    let given: Vec<String> = typed.iter().filter_map(long_name).collect();
    // The program and its command are there: the latter was found.
    let mut words: Vec<OsString> = typed[..2].to_vec();
    for (key, value) in &table {
        let refuse = |why: String| Failure::Config { file: file.clone(), key: key.clone(), why };
        let name = key.replace('_', "-");
        let option = known.get_arguments().find(|arg| arg.get_long() == Some(&name));
        let option = option.filter(|_| !TYPED_ONLY.contains(&name.as_str()));
        let option = option.ok_or_else(|| {
            refuse(format!("there is no such option; `argil {} --print-config` lists them", known.get_name()))
        })?;
        let ousted = |other: &Arg| other.get_long().is_some_and(|long| given.iter().any(|word| word == long));
        if ousted(option) || known.get_arg_conflicts_with(option).into_iter().any(ousted) {
            continue;
        }
        words.extend(as_typed(option, &name, value).map_err(refuse)?);
    }
    words.extend_from_slice(&typed[2..]);
    Ok(words)
}

/// The file after `--config`, also as `--config=FILE`.
fn named_file(typed: &[OsString]) -> Option<String> {
    let mut words = typed.iter().map(|word| word.to_string_lossy()).take_while(|word| word != "--");
    while let Some(word) = words.next() {
        if word == "--config" {
            return words.next().map(|file| file.into_owned());
        }
        if let Some(file) = word.strip_prefix("--config=") {
            return Some(file.to_owned());
        }
    }
    None
}

/// The long name of an option as it is typed; `-o` and `-q` are the only short ones.
fn long_name(word: &OsString) -> Option<String> {
    let word = word.to_string_lossy();
    match word.strip_prefix("--") {
        Some(long) => long.split('=').next().map(str::to_owned),
        None if word.starts_with("-o") => Some("output".to_owned()),
        None if word == "-q" => Some("quiet".to_owned()),
        None => None,
    }
}

/// A key and its value as words of a command line.
fn as_typed(option: &Arg, name: &str, value: &Value) -> Result<Option<OsString>, String> {
    let takes_value = option.get_action().takes_values();
    let text = match value {
        Value::Boolean(on) if !takes_value => return Ok(on.then(|| format!("--{name}").into())),
        _ if !takes_value => return Err("must be true or false".to_owned()),
        Value::String(text) => text.clone(),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => number.to_string(),
        _ => return Err("must be a number or a text in quotes".to_owned()),
    };
    Ok(Some(format!("--{name}={text}").into()))
}

/// The options of a command as a file: those that are set, and as comments those that are not.
pub(crate) fn as_file(command: &Command, matches: &ArgMatches) -> String {
    let mut text = format!("# Options of `argil {}`, for --config.\n", command.get_name());
    for option in command.get_arguments() {
        let Some(name) = option.get_long().filter(|name| !TYPED_ONLY.contains(name)) else { continue };
        let help = option.get_help().map(ToString::to_string).unwrap_or_default();
        text.push_str(&format!("\n# {}\n", help.lines().next().unwrap_or_default()));
        if !option.get_action().takes_values() {
            text.push_str(&format!("{name} = {}\n", matches.get_flag(option.get_id().as_str())));
            continue;
        }
        let value = matches.get_raw(option.get_id().as_str()).and_then(|mut values| values.next_back());
        match value.map(|value| value.to_string_lossy()) {
            Some(value) => text.push_str(&format!("{name} = {}\n", as_value(&value))),
            None => text.push_str(&format!("# {name} =\n")),
        }
    }
    text
}

/// A number as it is, anything else in quotes.
fn as_value(text: &str) -> String {
    let plain = text.parse::<f64>().is_ok_and(f64::is_finite) && text.parse::<Value>().is_ok();
    if plain { text.to_owned() } else { Value::String(text.to_owned()).to_string() }
}
