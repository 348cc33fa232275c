//! Documents: values in files, with the number of the schema that they were written by.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeSeed, Error, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A value as it goes into a file: `schema` stands among its own fields.
///
/// For whatever is written as a structure with names, such as [`Settings`], [`Plan`] and [`Strand`], in formats that
/// carry those names, such as JSON and TOML. The number rises when a field of any type of this workspace
/// changes its meaning or goes; a new field of a result may come at any time, and is passed over by those who do not know it.
/// Settings are read strictly: a field that is not known is an error, since a plan that leaves it out would be another one.
///
/// [`Settings`]: crate::Settings
/// [`Plan`]: crate::Plan
/// [`Strand`]: crate::strand::Strand
///
/// # Errors
/// Reading fails where the number is beyond [`Document::SCHEMA`]. A text without it counts as written by schema 1.
///
/// # Example
/// ```
/// use argil::{Document, Settings};
/// let text = serde_json::to_string(&Document(Settings::for_width(3.0)))?;
/// assert!(text.starts_with(r#"{"schema":1,"width":3.0,"#));
/// assert_eq!(Document::<Settings>::SCHEMA, 1);
/// let Document(settings): Document<Settings> = serde_json::from_str(&text)?;
/// assert_eq!(settings, Settings::for_width(3.0));
///
/// let later = text.replacen('1', "2", 1);
/// assert!(serde_json::from_str::<Document<Settings>>(&later).is_err());
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Document<T>(pub T);

impl<T> Document<T> {
    /// The schema that this version writes, and the last one that it reads.
    pub const SCHEMA: u32 = 1;
}

impl<T: Serialize> Serialize for Document<T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a, T> {
            schema: u32,
            #[serde(flatten)]
            content: &'a T,
        }
        Written { schema: Self::SCHEMA, content: &self.0 }.serialize(to)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Document<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_map(Content(PhantomData)).map(Self)
    }
}

/// Gives the fields to the content's own reader.
struct Content<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Content<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a structure with the number of its schema")
    }

    fn visit_map<A: MapAccess<'de>>(self, fields: A) -> Result<T, A::Error> {
        T::deserialize(MapAccessDeserializer::new(WithoutSchema(fields)))
    }
}

/// The fields without `schema`, which is checked where it is met. Taken out one by one, so that the content sees, and
/// refuses, what it does not know.
struct WithoutSchema<A>(A);

impl<'de, A: MapAccess<'de>> MapAccess<'de> for WithoutSchema<A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, A::Error> {
        while let Some(key) = self.0.next_key::<String>()? {
            if key != "schema" {
                return seed.deserialize(key.into_deserializer()).map(Some);
            }
            let (schema, last): (u64, _) = (self.0.next_value()?, Document::<()>::SCHEMA);
            if !(1..=u64::from(last)).contains(&schema) {
                let fault = format_args!("schema {schema} is not known: this version reads 1 to {last}");
                return Err(A::Error::custom(fault));
            }
        }
        Ok(None)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.0.next_value_seed(seed)
    }
}
