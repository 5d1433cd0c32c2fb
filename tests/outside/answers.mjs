// Validates a server's requests and responses against its OpenAPI document.
import Ajv2020 from 'ajv/dist/2020.js';
import addFormats from 'ajv-formats';
import yaml from 'js-yaml';

/** Parses JSON; a duplicate member of an object is an error. (YAML 1.2 is a superset of JSON.) */
export const parseStrictly = (text) => yaml.load(text, { schema: yaml.JSON_SCHEMA });

/** Ajv with its strict mode: an unknown keyword or a required member that is not defined is an error. */
export function strictAjv() {
  const ajv = new Ajv2020({ strict: true, allowUnionTypes: true, allErrors: true });
  addFormats(ajv);
  // OpenAPI 3.1 lets a schema have keys that begin with x-; Ajv wants to be told. This one: server/api/codegen/README.md.
  ajv.addKeyword('x-written-by');
  return ajv;
}

/** Rewrites a schema of the document so that its references point to schemasOf(). */
const standalone = (schema) => JSON.parse(JSON.stringify(schema).replaceAll('"#/components/schemas/', '"api#/$defs/'));

/** All schemas of the document as the definitions of one JSON Schema. */
export const schemasOf = (document) => ({ $id: 'api', $defs: standalone(document.components.schemas) });

const essence = (contentType) => (contentType ?? '').split(';')[0].trim();
const isJson = (type) => type === 'application/json' || type.endsWith('+json');

/** Validates requests and responses against the document and records which operations have succeeded. */
export class AnswerCheck {
  #ajv = strictAjv();
  #document;
  #validators = new Map();
  succeeded = new Set();

  constructor(document) {
    this.#document = document;
    this.#ajv.addSchema(schemasOf(document));
  }

  /** Throws unless the document allows this request body, which the server has accepted. */
  request(method, path, contentType, body) {
    const { requestBody } = this.#operation(method, path);
    if (!requestBody) throw new Error(`${method} ${path} takes no body, the document says`);
    this.#validate(`${method} ${path} request`, requestBody.content, contentType, body);
  }

  /** Throws unless the document allows this response: status, headers, media type, and JSON body. */
  response(method, path, response, body) {
    const operation = this.#operation(method, path);
    const what = `${method} ${path} ${response.status}`;
    const documented = this.#resolve(operation.responses[response.status] ?? operation.responses.default);
    if (response.ok && !operation.responses[response.status]) throw new Error(`${what} is not in the document`);
    for (const name of Object.keys(documented.headers ?? {}))
      if (!response.headers.has(name)) throw new Error(`${what} has no ${name}`);
    // A part of a JSON text (206) matches no schema.
    if (documented.content) this.#validate(what, documented.content, response.headers.get('Content-Type'), body);
    else if (body && response.status !== 206) throw new Error(`${what} has a body that is not in the document`);
    if (response.ok) this.succeeded.add(operation.operationId);
  }

  #operation(method, path) {
    const operation = this.#document.paths[path]?.[method.toLowerCase()];
    if (!operation) throw new Error(`${method} ${path} is not in the document`);
    return operation;
  }

  #resolve(node) {
    if (!node.$ref) return node;
    return node.$ref.slice(2).split('/').reduce((at, name) => at[name], this.#document);
  }

  #validate(what, content, contentType, body) {
    const type = essence(contentType);
    const media = content?.[type] ?? content?.['*/*'];
    if (!media) throw new Error(`${what}: ${type || 'no type'} is not in the document`);
    if (!isJson(type) || !media.schema) return;
    const key = `${what} ${type}`;
    if (!this.#validators.has(key)) this.#validators.set(key, this.#ajv.compile(standalone(media.schema)));
    const validate = this.#validators.get(key);
    if (!validate(parseStrictly(body)))
      throw new Error(`${what} is not as documented: ${this.#ajv.errorsText(validate.errors)}\n${body.slice(0, 2000)}`);
  }
}
