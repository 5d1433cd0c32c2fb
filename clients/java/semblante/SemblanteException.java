package semblante;

/** An error of the library. */
public final class SemblanteException extends RuntimeException {
    private static final long serialVersionUID = 1;

    /** The name of the result, such as "malformed". */
    public final String code;
    /** The member or byte at fault; may be empty. */
    public final String where;

    SemblanteException(String code, String where, String message) {
        super(where.isEmpty() ? message : where + ": " + message);
        this.code = code;
        this.where = where;
    }
}
